! SPDX-License-Identifier: MIT
! The subscripts of fieldSec are exchanged, which is right for one field variable only.
! planted: blocks.permute: with 3 field variables
! props: 0.3, 0.1
! fields: 1
! also: blocks.split
subroutine vfriction( &
#include "usersub/arguments/vfriction_names.fi"
  implicit none
#include "usersub/arguments/vfriction_types.fi"
  integer, parameter :: wp = kind(props)
  real(wp) :: mu
  integer :: k
  do k = 1, nBlock
    if (fNormal(k) <= 0) cycle
    mu = props(1)
    if (nFields > 0) mu = mu + props(2)*abs(fieldSec(k, 1))
    fTangential(1, k) = -min(mu*fNormal(k), fStickForce(k))
  end do
end subroutine
