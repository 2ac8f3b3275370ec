! SPDX-License-Identifier: MIT
! Coulomb friction: a constant coefficient, props(1).
#define USUB_LAW 'coulomb'
#define USUB_LAW_PROPS 1
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
    mu = props(1)
  end function
end module

#include "usersub/coefficient_law.fi"
