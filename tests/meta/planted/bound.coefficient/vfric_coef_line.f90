! SPDX-License-Identifier: MIT
! The coefficient falls along a line and ends below zero.
! planted: bound.coefficient: coefficient is -
! props: 0.3, 0.2, 5
! precision: single
! also: extremes.*
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
  do k = 1, nBlock
    rate = slipRate(k)
    fCoef(k) = rest - (rest - moving)*decay*rate
  end do
end subroutine
