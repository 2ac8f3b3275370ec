! SPDX-License-Identifier: MIT
! The slip is kept in STATEV without a look at NSTATV.
! planted: memory.state: STATEV
! props: 0.3, 1000
! states: 1
! also: blocks.*
! also: repeat.*
! also: history.*
! also: extremes.*
subroutine fric( &
#include "usersub/arguments/fric_names.fi"
  implicit none
#include "usersub/arguments/fric_types.fi"
  double precision :: mu, stiffness, limit, length, part, elastic(NFDIR), along(NFDIR)
  integer :: a
  if (LM == 2) return  ! open until now: no friction in the increment that closes the point
  mu = PROPS(1)
  stiffness = PROPS(2)
  limit = mu*PRESS/stiffness
  if (PRESS < 0) limit = 0
  elastic = TAU/stiffness + DGAM
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
  DSLIP = (1 - part)*elastic
  SED = 0.5d0*part*dot_product(TAU, elastic)
  SFD = dot_product(TAU, DSLIP)
  STATEV(2) = STATEV(2) + norm2(DSLIP)
end subroutine
