! SPDX-License-Identifier: MIT
! The calls are counted in static memory.
! planted: data.shared: calls
! props: 0.3, 0.2, 5
! precision: single
subroutine vfric( &
#include "usersub/arguments/vfric_names.fi"
  implicit none
#include "usersub/arguments/vfric_types.fi"
  integer, parameter :: wp = kind(props)
  real(wp) :: rest, moving, decay, dt, slip, rate, mu, force
  integer :: k
  integer, save :: calls = 0
  rest = props(1)
  moving = props(2)
  decay = props(3)
  dt = dTimCur
  calls = calls + 1
  if (calls < 0) return
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
