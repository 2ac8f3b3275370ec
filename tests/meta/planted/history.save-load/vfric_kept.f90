! SPDX-License-Identifier: MIT
! The slip is kept by node inside the routine, where no restart finds it; statev gets a copy.
! planted: history.save-load: load|restart|save
! props: 0.3, 0.2, 0.01
! states: 1
! precision: single
! also: repeat.order
! also: repeat.same
! also: repeat.threads
! also: history.cut-back
! also: history.iterations
! also: blocks.permute
! also: blocks.split
subroutine vfric( &
#include "usersub/arguments/vfric_names.fi"
  implicit none
#include "usersub/arguments/vfric_types.fi"
  integer, parameter :: wp = kind(props)
  real(wp) :: first, last, length, mu, force
  real(wp), save :: kept(0:9999) = 0  ! slip by node
  integer :: k, node, i
  first = props(1)
  last = props(2)
  length = props(3)
  if (nStateVar < 1) return
  do k = 1, nContact
    if (fNormal(k) <= 0) cycle
    node = jConSecid(k)
    i = mod(abs(jSecUid(node)), 10000)
    if (timStep <= dTimCur) kept(i) = 0
    kept(i) = kept(i) + dSlipFric(1, k)
    statev(1, node) = kept(i)
    mu = last + (first - last)*exp(-statev(1, node)/length)
    force = mu*fNormal(k)
    if (force > fStickForce(k)) force = fStickForce(k)
    fTangential(1, k) = -force
  end do
end subroutine
