! SPDX-License-Identifier: MIT
! Written with growing exponentials, the law has no value at high rates.
! planted: extremes.finite: (?i)nan|not a number|finite|inf
! props: 0.3, 0.2, 5
! precision: single
subroutine vfriction( &
#include "usersub/arguments/vfriction_names.fi"
  implicit none
#include "usersub/arguments/vfriction_types.fi"
  integer, parameter :: wp = kind(props)
  real(wp) :: rest, moving, decay, dt, slip, rate, mu, force, grows
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
    grows = exp(decay*rate)
    mu = (rest + moving*(grows - 1))/grows
    force = mu*fNormal(k)
    if (force > fStickForce(k)) force = fStickForce(k)
    fTangential(1, k) = -force
  end do
end subroutine
