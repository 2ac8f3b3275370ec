! SPDX-License-Identifier: MIT
! The largest normal force of the block sets the pressure of all.
! planted: blocks.split: block|split|call
! props: 0.3, 0.2, 5
! precision: single
! also: extremes.not-a-number
subroutine vfriction( &
#include "usersub/arguments/vfriction_names.fi"
  implicit none
#include "usersub/arguments/vfriction_types.fi"
  integer, parameter :: wp = kind(props)
  real(wp) :: rest, moving, decay, dt, slip, rate, mu, force, largest
  integer :: k
  rest = props(1)
  moving = props(2)
  decay = props(3)
  dt = rData(3)
  largest = 0
  do k = 1, nBlock
    if (.not. fNormal(k) <= largest) largest = fNormal(k)
  end do
  do k = 1, nBlock
    if (fNormal(k) <= 0) cycle
    slip = dSlipFric(1, k)
    rate = 0
    if (dt > 0) rate = slip/dt
    mu = moving + (rest - moving)*exp(-decay*rate - largest/1000)
    force = mu*fNormal(k)
    if (force > fStickForce(k)) force = fStickForce(k)
    fTangential(1, k) = -force
  end do
end subroutine
