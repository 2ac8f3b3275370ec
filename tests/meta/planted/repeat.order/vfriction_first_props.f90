! SPDX-License-Identifier: MIT
! The properties of the first call are kept for all interactions.
! planted: repeat.order: order|before|other|props
! props: 0.3, 0.2, 5
! precision: single
! also: repeat.same
! also: repeat.threads
! also: history.cut-back
! also: history.iterations
! also: history.save-load
! also: blocks.permute
! also: blocks.split
subroutine vfriction( &
#include "usersub/arguments/vfriction_names.fi"
  implicit none
#include "usersub/arguments/vfriction_types.fi"
  integer, parameter :: wp = kind(props)
  real(wp), save :: rest = 0, moving, decay
  real(wp) :: dt, slip, rate, mu, force
  integer :: k
  if (rest == 0) then
    rest = props(1)
    moving = props(2)
    decay = props(3)
  end if
  dt = rData(3)
  do k = 1, nBlock
    if (fNormal(k) <= 0) cycle
    slip = dSlipFric(1, k)
    rate = 0
    if (dt > 0) rate = slip/dt
    mu = moving + (rest - moving)*exp(-decay*rate)
    force = mu*fNormal(k)
    if (force > fStickForce(k)) force = fStickForce(k)
    fTangential(1, k) = -force
  end do
end subroutine
