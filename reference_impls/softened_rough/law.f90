! SPDX-License-Identifier: MIT
! No slip: all motion is elastic slip of a given stiffness, whatever the pressure; props: slope of
! shear stress over elastic slip. vectors: elastic slip.
#define USUB_LAW 'softened_rough'
#define USUB_LAW_PROPS 1
#define USUB_LAW_VECTORS 1
#include "usersub/laws.fi"

module usub_law_function
  use usub_law_tools
  implicit none
contains
  subroutine bristle( &
#include "usersub/bristle_names.fi"
      )
#include "usersub/bristle_types.fi"
    vectors(:, 1) = vectors(:, 1) + motion
    traction = props(1)*vectors(:, 1)
    if (present(tangent)) then
      tangent(1, 1) = props(1)
      tangent(2, 2) = props(1)
    end if
  end subroutine
end module

#include "usersub/bristle_law.fi"
