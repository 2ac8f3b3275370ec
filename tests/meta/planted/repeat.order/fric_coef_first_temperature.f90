! SPDX-License-Identifier: MIT
! The temperature of the first call is kept as the reference for all points.
! planted: repeat.order: order|before|other
! props: 0.3, 0.2, 5
! also: repeat.same
! also: repeat.threads
! also: history.cut-back
! also: history.iterations
! also: history.save-load
! also: blocks.permute
! also: blocks.split
subroutine fric_coef( &
#include "usersub/arguments/fric_coef_2022_names.fi"
  implicit none
#include "usersub/arguments/fric_coef_2022_types.fi"
  double precision :: rest, moving, decay, rate, change
  double precision :: warm
  double precision, save :: reference
  logical, save :: known = .false.
  integer :: k
  rest = props(1)
  moving = props(2)
  decay = props(3)
  if (.not. known .and. nBlock > 0 .and. nTemp > 0) then
    reference = tempAvg(1)
    known = .true.
  end if
  do k = 1, nBlock
    rate = slipData(k, 1)
    change = (rest - moving)*exp(-decay*rate)
    warm = 1
    if (nTemp > 0) warm = exp(-0.002d0*(tempAvg(k) - reference))
    fCoef(k, 1) = warm*(moving + change)
    fCoefDeriv(k, 1, 1) = -decay*change*warm  ! by rate, pressure, temperature
    fCoefDeriv(k, 2, 1) = 0
    fCoefDeriv(k, 3, 1) = -0.002d0*fCoef(k, 1)
  end do
end subroutine
