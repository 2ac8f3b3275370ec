! SPDX-License-Identifier: MIT
! Creep without a yield point: slip rate = k traction; props: k.
#define USUB_LAW 'viscoplastic_creep'
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
    traction = rate/props(1)
    if (present(derivative)) derivative(1) = 1/props(1)
  end function
end module

#include "usersub/traction_law.fi"
