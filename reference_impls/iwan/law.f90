! SPDX-License-Identifier: MIT
! Iwan friction: parallel elements of spring and slider; props: coefficient, number of elements,
! their stiffnesses, their shares of the strength.
#define USUB_LAW 'iwan'
#define USUB_LAW_VECTORS int(props(2))
#define USUB_LAW_READS_PRESSURE
#include "usersub/laws.fi"

module usub_law_function
  use usub_law_tools
  implicit none
contains
  ! Properties that the elements take; one more than there are, if the number makes no sense.
  pure integer function needed_props(props)
    real(wp), intent(in) :: props(:)
    needed_props = 4
    if (size(props) < 4) return
    needed_props = size(props) + 1
    if (props(2) >= 1 .and. props(2) <= size(props)) needed_props = 2 + 2*int(props(2))
  end function

  subroutine bristle( &
#include "usersub/bristle_names.fi"
      )
#include "usersub/bristle_types.fi"
    real(wp) :: limit, length, along(2), across(2), start(2), unit
    logical :: slips, sticks
    integer :: n, i, b
    n = int(props(2))
    traction = 0
    do i = 1, n
      associate (stiffness => props(2 + i), share => props(2 + n + i), element => vectors(:, i))
        limit = share*props(1)*pressure
        start = element
        unit = 1
        element = start + stiffness*motion
        length = hypot(element(1), element(2))
        if (.not. length <= huge(length)) then ! beyond the largest number: as a length
          unit = stiffness
          element = start/unit + motion
          length = hypot(element(1), element(2))
        end if
        slips = .not. (length < limit .and. unit == 1)
        ! left at its limit by a slip, it is above by rounding: at rest its tangent is that of stick
        sticks = .not. slips .or. (unit == 1 .and. limit > 0 .and. length <= limit*(1 + 4*epsilon(limit)))
        if (sticks .and. present(tangent)) then
          tangent(1, 1) = tangent(1, 1) + stiffness
          tangent(2, 2) = tangent(2, 2) + stiffness
        end if
        if (slips) then
          along = 0
          if (length > 0) along = element/length
          element = limit*along
          if (present(tangent) .and. .not. sticks) then
            across = [-along(2), along(1)]
            do b = 1, 2
              tangent(:, b) = tangent(:, b) + stiffness*ratio(limit, length)/unit*across*across(b)
            end do
            tangent(:, 3) = tangent(:, 3) + share*props(1)*along
          end if
        end if
        traction = traction + element
      end associate
    end do
  end subroutine
end module

#include "usersub/bristle_law.fi"
