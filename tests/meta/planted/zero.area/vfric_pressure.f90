! SPDX-License-Identifier: MIT
! The pressure is the normal force over an area that can be zero.
! planted: zero.area: (?i)nan|not a number|finite
! props: 0.3, 0.2, 5
! precision: single
! also: extremes.*
subroutine vfric( &
#include "usersub/arguments/vfric_names.fi"
  implicit none
#include "usersub/arguments/vfric_types.fi"
  integer, parameter :: wp = kind(props)
  real(wp) :: rest, moving, decay, dt, slip, rate, mu, force, p
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
    p = fNormal(k)/areaSec(jConSecid(k))  ! less friction under high pressure
    force = mu*(1 + p)/(1 + 2*p)*fNormal(k)
    if (force > fStickForce(k)) force = fStickForce(k)
    fTangential(1, k) = -force
  end do
end subroutine
