! SPDX-License-Identifier: MIT
! The temperature of the main surface is read for every point; an analytical rigid surface has
! one.
! planted: memory.analytical-rigid: temp
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
  real(wp) :: mean, rest, moving, decay, dt, slip, rate, mu, force
  integer :: k
  rest = props(1)
  moving = props(2)
  decay = props(3)
  dt = rData(3)
  do k = 1, nBlock
    if (fNormal(k) <= 0) cycle
    slip = dSlipFric(1, k)
    mean = 0
    if (nTemp > 0) mean = 0.5*(tempSec(k) + tempMain(k))
    rate = 0
    if (dt > 0) rate = slip/dt
    mu = moving + (rest - moving)*exp(-decay*rate)
    mu = mu*exp(-mean/500)
    force = mu*fNormal(k)
    if (force > fStickForce(k)) force = fStickForce(k)
    fTangential(1, k) = -force
  end do
end subroutine
