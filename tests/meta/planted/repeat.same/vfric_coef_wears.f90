! SPDX-License-Identifier: MIT
! The routine counts its calls, and the coefficient wears with them.
! planted: repeat.same: repe|again|second
! props: 0.3, 0.2, 5
! precision: single
! also: repeat.order
! also: repeat.threads
! also: history.cut-back
! also: history.iterations
! also: history.save-load
! also: blocks.permute
! also: blocks.split
subroutine vfric_coef( &
#include "usersub/arguments/vfric_coef_names.fi"
  implicit none
#include "usersub/arguments/vfric_coef_types.fi"
  integer, parameter :: wp = kind(props)
  real(wp) :: rest, moving, decay, rate
  real(wp), save :: wear = 1
  integer :: k
  rest = props(1)
  moving = props(2)
  decay = props(3)
  wear = wear*0.999_wp
  do k = 1, nBlock
    rate = slipRate(k)
    fCoef(k) = moving + wear*(rest - moving)*exp(-decay*rate)
  end do
end subroutine
