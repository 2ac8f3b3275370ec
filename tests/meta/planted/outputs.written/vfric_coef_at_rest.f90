! SPDX-License-Identifier: MIT
! A point that does not move is skipped, and with it its coefficient.
! planted: outputs.written: fCoef
! props: 0.3, 0.2, 5
! precision: single
subroutine vfric_coef( &
#include "usersub/arguments/vfric_coef_names.fi"
  implicit none
#include "usersub/arguments/vfric_coef_types.fi"
  integer, parameter :: wp = kind(props)
  real(wp) :: rest, moving, decay, rate
  integer :: k
  rest = props(1)
  moving = props(2)
  decay = props(3)
  do k = 1, nBlock
    rate = slipRate(k)
    if (rate == 0) cycle
    fCoef(k) = moving + (rest - moving)*exp(-decay*rate)
  end do
end subroutine
