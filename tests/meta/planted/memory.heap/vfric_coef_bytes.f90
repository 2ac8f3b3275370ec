! SPDX-License-Identifier: MIT
! Room is asked for in bytes and used in reals.
! planted: memory.heap: its own memory|it allocated
! props: 0.3, 0.2, 5
! precision: single
! also: memory.outside
! also: blocks.*
! also: repeat.*
! also: history.*
! also: extremes.*
! also: process.crash
subroutine vfric_coef( &
#include "usersub/arguments/vfric_coef_names.fi"
  implicit none
#include "usersub/arguments/vfric_coef_types.fi"
  integer, parameter :: wp = kind(props)
  real(wp) :: rest, moving, decay, rate
  real(wp), allocatable :: rates(:)
  integer :: k
  rest = props(1)
  moving = props(2)
  decay = props(3)
  allocate(rates((nBlock + 7)/8))
  do k = 1, nBlock
    rates(k) = slipRate(k)
  end do
  do k = 1, nBlock
    rate = rates(k)
    fCoef(k) = moving + (rest - moving)*exp(-decay*rate)
  end do
  deallocate(rates)
end subroutine
