! SPDX-License-Identifier: MIT
! A property is kept in an integer, which keeps its value only by luck.
! planted: precision.source: (?i)conver|integer|int|trunc
! props: 0.3, 0.2, 5
! precision: double
subroutine vfric_coef( &
#include "usersub/arguments/vfric_coef_names.fi"
  implicit none
#include "usersub/arguments/vfric_coef_types.fi"
  integer, parameter :: wp = kind(props)
  real(wp) :: rest, moving, rate
  integer :: k, decay
  rest = props(1)
  moving = props(2)
  decay = props(3)
  do k = 1, nBlock
    rate = slipRate(k)
    fCoef(k) = moving + (rest - moving)*exp(-decay*rate)
  end do
end subroutine
