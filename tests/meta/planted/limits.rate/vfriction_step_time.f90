! SPDX-License-Identifier: MIT
! The slip of the increment is divided by the step time.
! planted: limits.rate: step time
! props: 0.3, 0.2, 5
subroutine vfriction( &
#include "usersub/arguments/vfriction_names.fi"
  implicit none
#include "usersub/arguments/vfriction_types.fi"
  integer, parameter :: wp = kind(props)
  real(wp) :: rate, mu
  integer :: k
  do k = 1, nBlock
    if (fNormal(k) <= 0) cycle
    rate = 0
    if (rData(1) > 0) rate = dSlipFric(1, k)/rData(1)
    mu = props(2) + (props(1) - props(2))*exp(-props(3)*rate)
    fTangential(1, k) = -min(mu*fNormal(k), fStickForce(k))
  end do
end subroutine
