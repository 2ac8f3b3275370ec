! SPDX-License-Identifier: MIT
! Rate and state friction, ageing law, regularised at rest; props: f0, a, b, V0, Dc, theta0.
#define USUB_LAW 'rate_state_regularised'
#define USUB_LAW_PROPS 6
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
    real(wp) :: mu, theta_by_rate, value, by_rate, by_exponent
    associate (f0 => props(1), a => props(2), b => props(3), v0 => props(4), dc => props(5), &
        theta0 => props(6), theta => state(1))
      if (.not. theta > 0) theta = theta0
      call aged(theta, rate, time_increment, dc, theta_by_rate)
      call asinh_rate(rate, 2*v0, (f0 + b*log_scaled(v0, theta, dc))/a, value, by_rate, by_exponent)
      mu = a*value
      if (present(derivative)) &
          derivative(1) = a*by_rate + b*by_exponent*(theta_by_rate/theta)
    end associate
  end function
end module

#include "usersub/coefficient_law.fi"
