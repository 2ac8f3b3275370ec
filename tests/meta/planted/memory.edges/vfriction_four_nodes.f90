! SPDX-License-Identifier: MIT
! The main surface is taken to have facets of four nodes; an edge has two.
! planted: memory.edges: shapeMain|coordMain
! props: 0.3, 0.2, 0.01
! states: 2
! precision: single
! also: blocks.permute
! also: blocks.split
! also: repeat.same
! also: repeat.order
! also: repeat.threads
! also: history.save-load
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
  integer :: k, i
  first = props(1)
  last = props(2)
  length = props(3)
  if (nStates < 1) return
  do k = 1, nBlock
    if (fNormal(k) <= 0) cycle
    state(1, :, k) = state(1, :, k) + dSlipFric(1, k)  ! four times the same behind edges
    if (nStates > 1 .and. nNodMain > 1) then  ! height of the main surface
      state(2, 1, k) = 0
      do i = 1, 4
        state(2, 1, k) = state(2, 1, k) + shapeMain(i, k)*coordMain(3, i, k)
      end do
    end if
    mu = last + (first - last)*exp(-state(1, 1, k)/length)
    force = mu*fNormal(k)
    if (force > fStickForce(k)) force = fStickForce(k)
    fTangential(1, k) = -force
  end do
end subroutine
