! SPDX-License-Identifier: MIT
! Stribeck curve; props: static and kinetic coefficient, Stribeck rate, exponent, viscous part.
#define USUB_LAW 'stribeck'
#define USUB_LAW_PROPS 5
#define USUB_LAW_READS_RATE
#include "usersub/laws.fi"
#include "usersub/law_functions.fi"

module usub_law_function
  use usub_law_tools
  use usub_law_functions
  implicit none
contains
  function law( &
#include "usersub/law_names.fi"
      ) result(mu)
#include "usersub/law_types.fi"
    real(wp) :: mu
    real(wp) :: kinetic, fall, viscous, decay, slope
    kinetic = props(2)
    fall = props(1) - kinetic
    viscous = props(5)
    call decay_of_power(rate, 0.0_wp, props(3), props(4), decay, slope)
    mu = kinetic + fall*decay + viscous*rate
    if (present(derivative)) derivative(1) = fall*slope + viscous
  end function
end module

#include "usersub/coefficient_law.fi"
