! SPDX-License-Identifier: MIT
! Coulomb friction up to a largest shear stress; props: coefficient, largest shear stress.
#define USUB_LAW 'shear_limit'
#define USUB_LAW_PROPS 2
#define USUB_LAW_READS_PRESSURE
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
    if (.not. pressure > 0) return
    if (mu < props(2)/pressure) return
    mu = props(2)/pressure
    if (present(derivative)) derivative(2) = -mu/pressure
  end function
end module

#include "usersub/coefficient_law.fi"
