! SPDX-License-Identifier: MIT
! VFRIC: weakens with the slip of the node; props: coefficient at first, in the end, slip (length).
! props: 0.3, 0.2, 0.01
! states: 1
subroutine vfric( &
#include "usersub/arguments/vfric_names.fi"
  implicit none
#include "usersub/arguments/vfric_types.fi"
  integer, parameter :: wp = kind(props)
  real(wp) :: first, last, length, mu, force
  integer :: k, node
  first = props(1)
  last = props(2)
  length = props(3)
  if (nStateVar < 1) return
  do k = 1, nContact
    if (fNormal(k) <= 0) cycle
    node = jConSecid(k)
    statev(1, node) = statev(1, node) + dSlipFric(1, k)
    mu = last + (first - last)*exp(-statev(1, node)/length)
    force = mu*fNormal(k)
    if (force > fStickForce(k)) force = fStickForce(k)
    fTangential(1, k) = -force
  end do
end subroutine
