! SPDX-License-Identifier: MIT
! The coefficients at rest and at high rate are exchanged.
! planted: limits.rate: (?i)rest|rate|limit
! props: 0.3, 0.2, 5
! precision: single
subroutine vfric_coef( &
#include "usersub/arguments/vfric_coef_names.fi"
  implicit none
#include "usersub/arguments/vfric_coef_types.fi"
  integer, parameter :: wp = kind(props)
  real(wp) :: rest, moving, decay, rate
  integer :: k
  rest = props(2)
  moving = props(1)
  decay = props(3)
  do k = 1, nBlock
    rate = slipRate(k)
    fCoef(k) = moving + (rest - moving)*exp(-decay*rate)
  end do
end subroutine
