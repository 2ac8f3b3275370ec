! SPDX-License-Identifier: MIT
! A local array has room for six points.
! planted: memory.stack: (?i)stack|rates
! props: 0.3, 0.2, 5
! precision: single
! also: blocks.*
! also: repeat.*
! also: history.*
! also: extremes.*
subroutine vfriction( &
#include "usersub/arguments/vfriction_names.fi"
  implicit none
#include "usersub/arguments/vfriction_types.fi"
  integer, parameter :: wp = kind(props)
  real(wp) :: rest, moving, decay, dt, slip, rate, mu, force
  real(wp), volatile :: rates(6)
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
    rates(k) = rate
    force = mu*fNormal(k)
    if (force > fStickForce(k)) force = fStickForce(k)
    fTangential(1, k) = -force
  end do
end subroutine
