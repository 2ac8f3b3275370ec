! SPDX-License-Identifier: MIT
! A table of 64 MiB lies in the library, and in every process.
! planted: data.size: table|MiB
! props: 0.3, 0.2, 5
! precision: single
! also: data.shared
subroutine vfriction( &
#include "usersub/arguments/vfriction_names.fi"
  implicit none
#include "usersub/arguments/vfriction_types.fi"
  integer, parameter :: wp = kind(props)
  real(wp) :: rest, moving, decay, dt, slip, rate, mu, force
  integer :: k
  double precision :: table
  common /nodes/ table(8388608)
  rest = props(1)
  moving = props(2)
  decay = props(3)
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
    table(1 + mod(abs(jConSecUid(1, k)), 8388608)) = force
  end do
end subroutine
