! SPDX-License-Identifier: MIT
! VFRICTION: weakens with the slip of the point; props: coefficient at first, in the end, slip
! (length).
! props: 0.3, 0.2, 0.01
! states: 1
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
  if (nStates < 1) return
  do k = 1, nBlock
    if (fNormal(k) <= 0) cycle
    state(1, :, k) = state(1, :, k) + dSlipFric(1, k)  ! four times the same behind edges
    mu = last + (first - last)*exp(-state(1, 1, k)/length)
    force = mu*fNormal(k)
    if (force > fStickForce(k)) force = fStickForce(k)
    fTangential(1, k) = -force
  end do
end subroutine
