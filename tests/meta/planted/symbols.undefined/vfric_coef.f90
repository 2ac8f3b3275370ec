! SPDX-License-Identifier: MIT
! The function of the coefficient stands in another file.
! planted: symbols.undefined: (?i)coefficient_of_rate
! props: 0.3, 0.2, 5
! precision: single
subroutine vfric_coef( &
#include "usersub/arguments/vfric_coef_names.fi"
  implicit none
#include "usersub/arguments/vfric_coef_types.fi"
  integer, parameter :: wp = kind(props)
  real(wp) :: rest, moving, decay, rate
  real(wp), external :: coefficient_of_rate
  integer :: k
  rest = props(1)
  moving = props(2)
  decay = props(3)
  do k = 1, nBlock
    rate = slipRate(k)
    fCoef(k) = moving + (rest - moving)*coefficient_of_rate(decay*rate)
  end do
end subroutine
