! SPDX-License-Identifier: MIT
! Infinity over infinity where there is no time, and MIN makes the stick force of it.
! planted: zero.time-step: stick force
! props: 0.3, 0.1, 0.2
subroutine vfric( &
#include "usersub/arguments/vfric_names.fi"
  implicit none
#include "usersub/arguments/vfric_types.fi"
  integer, parameter :: wp = kind(props)
  real(wp) :: rate, mu
  integer :: k
  do k = 1, nContact
    if (fNormal(k) <= 0) cycle
    rate = dSlipFric(1, k)/dTimCur
    mu = props(1) - props(2)*rate/(rate + props(3))
    fTangential(1, k) = -min(mu*fNormal(k), fStickForce(k))
  end do
end subroutine
