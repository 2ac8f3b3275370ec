! SPDX-License-Identifier: MIT
! The slip is turned into a rate in place.
! planted: inputs.kept: dSlipFric
! props: 0.3, 0.2, 5
! precision: single
subroutine vfriction( &
#include "usersub/arguments/vfriction_names.fi"
  implicit none
#include "usersub/arguments/vfriction_types.fi"
  integer, parameter :: wp = kind(props)
  real(wp) :: rest, moving, decay, dt, rate, mu, force
  integer :: k
  rest = props(1)
  moving = props(2)
  decay = props(3)
  dt = rData(3)
  do k = 1, nBlock
    if (fNormal(k) <= 0) cycle
    rate = 0
    if (dt > 0) rate = dSlipFric(1, k)/dt
    dSlipFric(1, k) = rate
    mu = moving + (rest - moving)*exp(-decay*rate)
    force = mu*fNormal(k)
    if (force > fStickForce(k)) force = fStickForce(k)
    fTangential(1, k) = -force
  end do
end subroutine
