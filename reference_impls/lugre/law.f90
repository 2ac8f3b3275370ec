! SPDX-License-Identifier: MIT
! LuGre friction: a bristle with damping, Stribeck curve and viscous friction;
! props: mus, muk, vs, delta, sigma0, sigma1, sigma2.
#define USUB_LAW 'lugre'
#define USUB_LAW_PROPS 7
#define USUB_LAW_VECTORS 1
#define USUB_LAW_READS_PRESSURE
#define USUB_LAW_READS_TIME
#include "usersub/laws.fi"
#include "usersub/law_functions.fi"

module usub_law_function
  use usub_law_tools
  use usub_law_functions
  implicit none
contains
  subroutine bristle( &
#include "usersub/bristle_names.fi"
      )
#include "usersub/bristle_types.fi"
    real(wp) :: per_time, length, rate, mu, mu_by_rate, strength, limit, along(2), across(2)
    real(wp) :: x, kept, gone, bend(2), speed(2), strength_by_length, x_by_length, column(2)
    integer :: b
    associate (stiffness => props(5), damping => props(6), viscosity => props(7), z => vectors(:, 1))
      per_time = ratio(1.0_wp, time_increment)
      length = hypot(motion(1), motion(2))
      rate = length*per_time
      call stribeck(rate, props(1), props(2), props(3), props(4), mu, mu_by_rate)
      strength = pressure*mu
      limit = strength/stiffness
      along = 0
      if (length > 0) along = motion/length
      x = 0
      if (limit > tiny(limit)) x = min(stiffness*length/strength, 1e30_wp)
      speed = 0 ! of z, at the end

      if (.not. limit > tiny(limit)) then ! the bristle carries nothing, it will with the pressure
        z = 0
        if (present(tangent)) tangent(:, 3) = mu*along
      else if (x > 0) then
        kept = exp(-x)
        gone = -expm1(-x)
        across = [-along(2), along(1)]
        bend = along - z/limit ! how far from steady slip
        speed = kept*rate*bend
        if (present(tangent)) then
          strength_by_length = pressure*mu_by_rate*per_time
          x_by_length = (stiffness - x*strength_by_length)/strength
          column = strength*kept*bend*x_by_length + gone*strength_by_length*along &
              + damping*(kept*per_time*(along - (1 - rate*mu_by_rate/mu)*z/limit) &
              - speed*x_by_length)
          do b = 1, 2
            tangent(:, b) = column*along(b) &
                + (strength*(gone/length) + damping*kept*per_time)*across*across(b)
          end do
          tangent(:, 3) = mu*(gone*along - x*kept*bend) &
              + damping*kept*rate*(x*bend + z/limit)/pressure
        end if
        z = kept*z + gone*limit*along
      else ! at rest: the derivative is that of each component from above
        if (present(tangent)) then
          do b = 1, 2
            tangent(:, b) = -(stiffness + damping*per_time)*(z/limit)
            tangent(b, b) = tangent(b, b) + stiffness + damping*per_time
          end do
        end if
        z = z + motion
        speed = per_time*motion
      end if

      traction = stiffness*z + damping*speed + viscosity*per_time*motion
      if (present(tangent)) then
        do b = 1, 2
          tangent(b, b) = tangent(b, b) + viscosity*per_time
        end do
      end if
    end associate
  end subroutine
end module

#include "usersub/bristle_law.fi"
