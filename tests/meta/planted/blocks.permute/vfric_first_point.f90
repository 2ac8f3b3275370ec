! SPDX-License-Identifier: MIT
! The rate of the first point is taken for all.
! planted: blocks.permute: order|permut|place|position
! props: 0.3, 0.2, 5
! precision: single
! also: blocks.split
! also: extremes.not-a-number
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
    slip = dSlipFric(1, 1)
    rate = 0
    if (dt > 0) rate = slip/dt
    mu = moving + (rest - moving)*exp(-decay*rate)
    force = mu*fNormal(k)
    if (force > fStickForce(k)) force = fStickForce(k)
    fTangential(1, k) = -force
  end do
end subroutine
