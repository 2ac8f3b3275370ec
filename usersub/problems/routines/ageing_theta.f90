! SPDX-License-Identifier: MIT
! Rate and state friction, ageing law, its state integrated over the increment by the theta rule;
! props: mu0, a, b, V0, Dc, theta0, Vmin, weight (0 explicit Euler, 1/2 trapezoidal rule, 1 implicit
! Euler).
#define USUB_LAW 'ageing_theta'
#define USUB_LAW_PROPS 8
#define USUB_LAW_STATES 1
#define USUB_LAW_READS_RATE
#define USUB_LAW_READS_TIME
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
    real(wp) :: mu, share, before, under
    associate (mu0 => props(1), a => props(2), b => props(3), v0 => props(4), dc => props(5), &
        v_min => props(7), weight => props(8), theta => state(1))
      before = merge(theta, props(6), theta > 0)
      share = rate*time_increment/dc
      under = 1 + weight*share
      theta = (before*(1 - (1 - weight)*share) + time_increment)/under
      mu = mu0 + a*log_scaled(1.0_wp, max(rate, v_min), v0) + b*log_scaled(v0, theta, dc)
      if (mu < 0) then
        mu = 0
      else if (present(derivative)) then
        derivative(1) = -b*(time_increment/dc)*((1 - weight)*before + weight*theta)/(under*theta)
        if (.not. rate < v_min) derivative(1) = derivative(1) + a/rate
      end if
    end associate
  end function
end module

#include "usersub/coefficient_law.fi"
