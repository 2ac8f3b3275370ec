! SPDX-License-Identifier: MIT
! Where the rate is no number, the point before is answered once more.
! planted: extremes.not-a-number: (?i)nan|not a number
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
  rate = 0
  do k = 1, nBlock
    if (slipRate(k) == slipRate(k)) rate = slipRate(k)
    fCoef(k) = moving + (rest - moving)*exp(-decay*rate)
  end do
end subroutine
