! SPDX-License-Identifier: MIT
! A share of the shear yield stress, whatever the pressure; props: friction factor, yield stress.
#define USUB_LAW 'tresca'
#define USUB_LAW_PROPS 2
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
    strength = props(1)*props(2)
  end function
end module

#include "usersub/strength_law.fi"
