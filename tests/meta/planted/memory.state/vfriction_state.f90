! SPDX-License-Identifier: MIT
! The state is used without a look at the number of its variables.
! planted: memory.state: state
! props: 0.3, 0.2, 0.01
! states: 1
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
  real(wp) :: first, last, length, mu, force
  integer :: k
  first = props(1)
  last = props(2)
  length = props(3)
  do k = 1, nBlock
    if (fNormal(k) <= 0) cycle
    state(1, :, k) = state(1, :, k) + dSlipFric(1, k)  ! four times the same behind edges
    state(2, :, k) = fNormal(k)
    mu = last + (first - last)*exp(-state(1, 1, k)/length)
    force = mu*fNormal(k)
    if (force > fStickForce(k)) force = fStickForce(k)
    fTangential(1, k) = -force
  end do
end subroutine
