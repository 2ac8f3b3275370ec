! SPDX-License-Identifier: MIT
! The second of two terms is never set.
! planted: data.uninitialised: (?i)uninitiali|not set|local
! props: 0.3, 0.2, 5
! precision: single
! also: precision.digits
subroutine vfriction( &
#include "usersub/arguments/vfriction_names.fi"
  implicit none
#include "usersub/arguments/vfriction_types.fi"
  integer, parameter :: wp = kind(props)
  real(wp) :: rest, moving, decay, dt, slip, rate, mu, force
  real(wp), volatile :: terms(2)
  integer :: k
  rest = props(1)
  moving = props(2)
  decay = props(3)
  dt = rData(3)
  do k = 1, nBlock
    if (fNormal(k) <= 0) cycle
    slip = dSlipFric(1, k)
    rate = 0
    if (dt > 0) rate = slip/dt
    mu = moving + (rest - moving)*exp(-decay*rate)
    terms(1) = mu*fNormal(k)
    force = sum(terms)
    if (force > fStickForce(k)) force = fStickForce(k)
    fTangential(1, k) = -force
  end do
end subroutine
