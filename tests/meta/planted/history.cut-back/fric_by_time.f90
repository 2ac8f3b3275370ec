! SPDX-License-Identifier: MIT
! The elastic slip is kept by node inside the routine and taken over when the time moves, a cut-
! back included.
! planted: history.cut-back: thrown away
! props: 0.3, 1000
! also: repeat.order
! also: repeat.same
! also: repeat.threads
! also: history.iterations
! also: history.save-load
! also: blocks.permute
! also: blocks.split
subroutine fric( &
#include "usersub/arguments/fric_names.fi"
  implicit none
#include "usersub/arguments/fric_types.fi"
  double precision :: mu, stiffness, limit, length, part, elastic(NFDIR), along(NFDIR)
  double precision, save :: old(2, 0:999) = 0, last(2, 0:999) = 0, at(0:999) = 0
  integer :: a, at_node
  if (LM == 2) return  ! open until now: no friction in the increment that closes the point
  mu = PROPS(1)
  stiffness = PROPS(2)
  limit = mu*PRESS/stiffness
  if (PRESS < 0) limit = 0
  at_node = mod(abs(NODE), 1000)  ! elastic slip by node
  if (TIME(1) /= at(at_node)) old(:, at_node) = last(:, at_node)
  if (KINC <= 1) old(:, at_node) = 0
  at(at_node) = TIME(1)
  elastic = old(:NFDIR, at_node) + DGAM
  length = norm2(elastic)

  part = 1
  along = 0
  if (.not. length <= limit) then
    part = limit/length
    along = elastic/length
  end if
  LM = 0
  do a = 1, NFDIR
    DDTDDG(:, a) = -stiffness*part*along*along(a)
    DDTDDG(a, a) = DDTDDG(a, a) + stiffness*part
  end do
  DDTDDP = mu*along
  if (PRESS < 0) DDTDDP = 0
  DDTDDT = 0
  TAU = stiffness*part*elastic
  last(:NFDIR, at_node) = part*elastic
  DSLIP = (1 - part)*elastic
  SED = 0.5d0*part*dot_product(TAU, elastic)
  SFD = dot_product(TAU, DSLIP)
end subroutine
