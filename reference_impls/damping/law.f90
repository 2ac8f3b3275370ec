! SPDX-License-Identifier: MIT
! Tangential damping: shear stress proportional to the slip rate; props: damping coefficient.
#define USUB_LAW 'damping'
#define USUB_LAW_PROPS 1
#define USUB_LAW_READS_RATE
#include "usersub/laws.fi"

module usub_law_function
  use usub_law_tools
  implicit none
contains
  function law( &
#include "usersub/law_names.fi"
      ) result(traction)
#include "usersub/law_types.fi"
    real(wp) :: traction
    traction = props(1)*rate
    if (present(derivative)) derivative(1) = props(1)
  end function
end module

#include "usersub/traction_law.fi"
