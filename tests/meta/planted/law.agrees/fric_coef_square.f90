! SPDX-License-Identifier: MIT
! The decay goes with the square of the rate.
! planted: law.agrees: (?i)exponential_decay|agree|law
! props: 0.3, 0.2, 5
! law: exponential_decay
subroutine fric_coef( &
#include "usersub/arguments/fric_coef_2022_names.fi"
  implicit none
#include "usersub/arguments/fric_coef_2022_types.fi"
  double precision :: rest, moving, decay, rate, change
  integer :: k
  rest = props(1)
  moving = props(2)
  decay = props(3)
  do k = 1, nBlock
    rate = slipData(k, 1)
    change = (rest - moving)*exp(-(decay*rate)**2)
    fCoef(k, 1) = moving + change
    fCoefDeriv(k, 1, 1) = -2*decay**2*rate*change  ! by rate, pressure, temperature
    fCoefDeriv(k, 2:3, 1) = 0
  end do
end subroutine
