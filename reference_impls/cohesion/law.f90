! SPDX-License-Identifier: MIT
! Coulomb friction with cohesion; props: cohesion, coefficient.
#define USUB_LAW 'cohesion'
#define USUB_LAW_PROPS 2
#define USUB_LAW_READS_PRESSURE
#include "usersub/laws.fi"

module usub_law_function
  use usub_law_tools
  implicit none
contains
  function law( &
#include "usersub/law_names.fi"
      ) result(strength)
#include "usersub/law_types.fi"
    real(wp) :: strength
    strength = props(1) + props(2)*pressure
    if (present(derivative)) derivative(2) = props(2)
  end function
end module

#include "usersub/strength_law.fi"
