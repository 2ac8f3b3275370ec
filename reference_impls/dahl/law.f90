! SPDX-License-Identifier: MIT
! Dahl friction: a bristle that bends and slips; props: coefficient, stiffness.
#define USUB_LAW 'dahl'
#define USUB_LAW_PROPS 2
#define USUB_LAW_VECTORS 1
#define USUB_LAW_READS_PRESSURE
#include "usersub/laws.fi"
#include "usersub/law_functions.fi"

module usub_law_function
  use usub_law_tools
  use usub_law_functions
  implicit none
contains
  subroutine bristle( &
#include "usersub/bristle_names.fi"
      )
#include "usersub/bristle_types.fi"
    real(wp) :: strength, limit, length, along(2), across(2), bend(2), x, kept, gone
    integer :: b
    associate (mu => props(1), stiffness => props(2), z => vectors(:, 1))
      strength = mu*pressure
      limit = strength/stiffness
      length = hypot(motion(1), motion(2))
      along = 0
      if (length > 0) along = motion/length
      x = 0
      if (limit > tiny(limit)) x = min(stiffness*length/strength, 1e30_wp)

      if (.not. limit > tiny(limit)) then ! no traction, but it grows with the pressure
        z = 0
        if (present(tangent)) tangent(:, 3) = mu*along
      else if (x > 0) then
        kept = exp(-x)
        gone = -expm1(-x)
        across = [-along(2), along(1)]
        bend = along - z/limit ! how far from steady slip
        if (present(tangent)) then
          do b = 1, 2
            tangent(:, b) = stiffness*kept*bend*along(b) + strength*(gone/length)*across*across(b)
          end do
          tangent(:, 3) = mu*(gone*along - x*kept*bend)
        end if
        z = kept*z + gone*limit*along
      else ! at rest: the derivative is that of each component from above
        if (present(tangent)) then
          do b = 1, 2
            tangent(:, b) = -stiffness*(z/limit)
            tangent(b, b) = tangent(b, b) + stiffness
          end do
        end if
        z = z + motion
      end if
      traction = stiffness*z
    end associate
  end subroutine
end module

#include "usersub/bristle_law.fi"
