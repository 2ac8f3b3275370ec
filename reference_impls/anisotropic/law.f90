! SPDX-License-Identifier: MIT
! A constant coefficient in each of both local directions; props: the two.
#define USUB_LAW 'anisotropic'
#define USUB_LAW_ANISOTROPIC
#define USUB_LAW_PROPS 2
#include "usersub/laws.fi"

module usub_law_function
  use usub_law_tools
  implicit none
contains
  subroutine law( &
#include "usersub/law_names.fi"
      )
#include "usersub/law_types.fi"
    mu = props(1:2)
  end subroutine
end module

#include "usersub/coefficient_law.fi"
