! SPDX-License-Identifier: MIT
! The coefficient is that of the fastest point of the block.
! planted: blocks.split: block|split|call
! props: 0.3, 0.2, 5
! precision: single
! also: extremes.not-a-number
subroutine vfric_coef( &
#include "usersub/arguments/vfric_coef_names.fi"
  implicit none
#include "usersub/arguments/vfric_coef_types.fi"
  integer, parameter :: wp = kind(props)
  real(wp) :: rest, moving, decay, rate
  integer :: k
  rest = props(1)
  moving = props(2)
  decay = props(3)
  rate = 0
  do k = 1, nBlock
    if (.not. slipRate(k) <= rate) rate = slipRate(k)
  end do
  do k = 1, nBlock
    fCoef(k) = moving + (rest - moving)*exp(-decay*rate)
  end do
end subroutine
