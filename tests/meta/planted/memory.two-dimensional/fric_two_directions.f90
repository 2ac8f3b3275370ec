! SPDX-License-Identifier: MIT
! Two friction directions are taken for granted.
! planted: memory.two-dimensional: DGAM|TAU
! props: 0.3, 1000
! also: blocks.*
! also: repeat.*
! also: history.*
! also: extremes.*
subroutine fric( &
#include "usersub/arguments/fric_names.fi"
  implicit none
#include "usersub/arguments/fric_types.fi"
  double precision :: mu, stiffness, limit, length, part, elastic(2), along(2)
  integer :: a
  if (LM == 2) return  ! open until now: no friction in the increment that closes the point
  mu = PROPS(1)
  stiffness = PROPS(2)
  limit = mu*PRESS/stiffness
  if (PRESS < 0) limit = 0
  elastic(1) = TAU(1)/stiffness + DGAM(1)
  elastic(2) = TAU(2)/stiffness + DGAM(2)
  length = norm2(elastic)

  part = 1
  along = 0
  if (.not. length <= limit) then
    part = limit/length
    along = elastic/length
  end if
  LM = 0
  do a = 1, NFDIR
    DDTDDG(:, a) = -stiffness*part*along(:NFDIR)*along(a)
    DDTDDG(a, a) = DDTDDG(a, a) + stiffness*part
  end do
  DDTDDP = mu*along(:NFDIR)
  if (PRESS < 0) DDTDDP = 0
  DDTDDT = 0
  TAU = stiffness*part*elastic(:NFDIR)
  DSLIP = (1 - part)*elastic(:NFDIR)
  SED = 0.5d0*part*dot_product(TAU, elastic(:NFDIR))
  SFD = dot_product(TAU, DSLIP)
end subroutine
