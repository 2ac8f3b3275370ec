! SPDX-License-Identifier: MIT
! No friction.
#define USUB_LAW 'frictionless'
#define USUB_LAW_PROPS 0
#include "usersub/laws.fi"

module usub_law_function
  use usub_law_tools
  implicit none
contains
  function law( &
#include "usersub/law_names.fi"
      ) result(mu)
#include "usersub/law_types.fi"
    real(wp) :: mu
    mu = 0
  end function
end module

#include "usersub/coefficient_law.fi"
