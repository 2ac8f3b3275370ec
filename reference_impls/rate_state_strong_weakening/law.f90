! SPDX-License-Identifier: MIT
! Rate and state friction with strong weakening at high rates (flash heating), slip law;
! props: f0, a, b, V0, Dc, theta0, fw, Vw, Vmin.
#define USUB_LAW 'rate_state_strong_weakening'
#define USUB_LAW_PROPS 9
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
  ! (1 + ratio^8)^(-1/8), without overflow, and its derivative.
  pure subroutine weakening(ratio, share, slope)
    real(wp), intent(in) :: ratio
    real(wp), intent(out) :: share, slope
    if (ratio < 1) then
      share = (1 + ratio**8)**(-0.125_wp)
      slope = -share/(1 + ratio**8)*ratio**7
    else
      share = (1 + (1/ratio)**8)**(-0.125_wp)
      slope = -share/(1 + (1/ratio)**8)*(1/ratio)**2
      share = share/ratio
    end if
  end subroutine

  function law( &
#include "usersub/law_names.fi"
      ) result(mu)
#include "usersub/law_types.fi"
    real(wp) :: mu, x, v, logarithmic, drop, share, slope, first, steady, psi, value
    real(wp) :: by_own, by_exponent, by_log, size_by_rate, steady_by_rate, psi_by_rate, magnitude
    associate (f0 => props(1), a => props(2), b => props(3), v0 => props(4), dc => props(5), &
        theta0 => props(6), fw => props(7), vw => props(8), v_min => props(9), theta => state(1))
      if (.not. theta > 0) theta = theta0
      x = rate*time_increment/dc
      v = max(rate, v_min, tiny(rate))
      logarithmic = f0 + (a - b)*log_scaled(1.0_wp, v, v0)
      drop = max(logarithmic - fw, 0.0_wp)
      call weakening(rate/vw, share, slope)
      magnitude = (fw + drop*share)/a

      ! psi = f0 + b ln(V0 theta/Dc) decays to that of steady sliding, a ln(2 V0/v sinh(magnitude))
      steady = a*(log_scaled(1.0_wp, v0, v) + magnitude + log(-expm1(-2*magnitude)))
      first = f0 + b*log_scaled(v0, theta, dc)
      psi = first*exp(-x) - steady*expm1(-x)
      theta = dc/v0*exp(min(max((psi - f0)/b, -most_exponent), most_exponent))

      call asinh_rate(rate, 2*v0, psi/a, value, by_own, by_exponent)
      mu = a*value
      if (present(derivative)) then
        by_log = 0
        if (.not. rate < v) by_log = 1/v
        size_by_rate = drop*slope/vw/a
        if (drop > 0) size_by_rate = size_by_rate + (a - b)*by_log*share/a
        steady_by_rate = a*(size_by_rate/tanh(magnitude) - by_log)
        psi_by_rate = -steady_by_rate*expm1(-x)
        if (exp(-x) > 0) psi_by_rate = (steady - first)*exp(-x)*(time_increment/dc) + psi_by_rate
        derivative(1) = a*by_own + by_exponent*psi_by_rate
      end if
    end associate
  end function
end module

#include "usersub/coefficient_law.fi"
