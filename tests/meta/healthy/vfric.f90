! SPDX-License-Identifier: MIT
! VFRIC: decay by slip rate; props: coefficient at rest, at high rate, decay (time/length).
! props: 0.3, 0.2, 5
subroutine vfric( &
#include "usersub/arguments/vfric_names.fi"
  implicit none
#include "usersub/arguments/vfric_types.fi"
  integer, parameter :: wp = kind(props)
  real(wp) :: rest, moving, decay, dt, slip, rate, mu, force
  integer :: k
  rest = props(1)
  moving = props(2)
  decay = props(3)
  dt = dTimCur
  do k = 1, nContact
    if (fNormal(k) <= 0) cycle
    slip = dSlipFric(1, k)
    rate = 0
    if (dt > 0) rate = slip/dt
    mu = moving + (rest - moving)*exp(-decay*rate)
    force = mu*fNormal(k)
    if (force > fStickForce(k)) force = fStickForce(k)
    fTangential(1, k) = -force
  end do
end subroutine
