! SPDX-License-Identifier: MIT
! The cell of a table comes from a division by an integer that can be zero.
! planted: process.crash: (?i)divi|crash
! props: 0.3, 0.2, 5
subroutine fric_coef( &
#include "usersub/arguments/fric_coef_2022_names.fi"
  implicit none
#include "usersub/arguments/fric_coef_2022_types.fi"
  double precision :: rest, moving, decay, rate, change
  integer :: k, cells
  rest = props(1)
  moving = props(2)
  decay = props(3)
  do k = 1, nBlock
    rate = slipData(k, 1)
    change = (rest - moving)*exp(-decay*rate)
    cells = int(1000*rate)
    cells = 1000/cells
    fCoef(k, 1) = moving + change
    if (cells == 77) fCoef(k, 1) = 0
    fCoefDeriv(k, 1, 1) = -decay*change  ! by rate, pressure, temperature
    fCoefDeriv(k, 2:3, 1) = 0
  end do
end subroutine
