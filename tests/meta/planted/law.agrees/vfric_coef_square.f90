! SPDX-License-Identifier: MIT
! The decay goes with the square of the rate.
! planted: law.agrees: (?i)exponential_decay|agree|law
! props: 0.3, 0.2, 5
! precision: single
! law: exponential_decay
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
    fCoef(k) = moving + (rest - moving)*exp(-(decay*rate)**2)
  end do
end subroutine
