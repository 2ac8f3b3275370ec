! SPDX-License-Identifier: MIT
! Generalised Maxwell slip: elements that stick as springs and, slipping, are attracted by a Stribeck
! curve; props: mus, muk, vs, delta, attraction, viscosity, number of elements, their stiffnesses,
! their shares of the strength.
#define USUB_LAW 'maxwell_slip'
#define USUB_LAW_VECTORS int(props(7))
#define USUB_LAW_STATES int(props(7))
#define USUB_LAW_READS_PRESSURE
#define USUB_LAW_READS_TIME
#include "usersub/laws.fi"
#include "usersub/law_functions.fi"

module usub_law_function
  use usub_law_tools
  use usub_law_functions
  implicit none
  private
  public :: bristle, needed_props

  ! What all elements share; derivatives of the strength.
  type :: sliding
    real(wp) :: length, along(2), across(2), time, attraction, strength
  end type

  ! One element: its traction in the directions of the motion; slip begins at `begin`, after the
  ! motion `stick`.
  type :: spring
    real(wp) :: stiffness, share, along, across, begin, stick
  end type
contains
  ! Properties that the elements take; one more than there are, if the number makes no sense.
  pure integer function needed_props(props)
    real(wp), intent(in) :: props(:)
    needed_props = 9
    if (size(props) < 9) return
    needed_props = size(props) + 1
    if (props(7) >= 1 .and. props(7) <= size(props)) needed_props = 7 + 2*int(props(7))
  end function

  ! How much of the distance to the Stribeck curve is left after a time; its derivatives.
  pure subroutine decay(s, time, left, by_time, by_strength)
    type(sliding), intent(in) :: s
    real(wp), intent(in) :: time
    real(wp), intent(out) :: left, by_time, by_strength
    left = 0
    if (s%strength > 0) left = exp(-s%attraction*time/s%strength)
    by_time = 0
    by_strength = 0
    if (.not. left > 0) return
    by_time = -left*s%attraction/s%strength
    by_strength = left*s%attraction*time/s%strength/s%strength
  end subroutine

  ! An element under motion, which slips in the end or not.
  pure subroutine move(s, motion, e, traction, slips)
    type(sliding), intent(in) :: s
    real(wp), intent(in) :: motion(2)
    type(spring), intent(inout) :: e
    real(wp), intent(inout) :: traction(2)
    logical, intent(inout) :: slips
    real(wp) :: limit, reach, left, unused(2)
    limit = e%share*s%strength
    e%along = dot_product(traction, s%along)
    e%across = dot_product(traction, s%across)
    e%begin = e%along
    e%stick = 0
    if (.not. (slips .and. e%along > 0)) then
      reach = 0
      if (abs(e%across) < limit) reach = sqrt((limit - e%across)*(limit + e%across))
      if (e%along < reach) then
        e%begin = reach
        e%stick = (reach - e%along)/e%stiffness
      end if
    end if
    slips = .not. s%length < e%stick
    if (slips) then
      call decay(s, s%time*(1 - e%stick/s%length), left, unused(1), unused(2))
      traction = (limit + (e%begin - limit)*left)*s%along + e%across*left*s%across
    else
      traction = traction + e%stiffness*motion
    end if
  end subroutine

  ! Derivative of the traction of an element that slips, by one variable: given are those of the
  ! length of the motion, of its angle and of the strength.
  pure function slip_derivative(s, e, d_length, d_angle, d_strength) result(derivative)
    type(sliding), intent(in) :: s
    type(spring), intent(in) :: e
    real(wp), intent(in) :: d_length, d_angle, d_strength
    real(wp) :: derivative(2), limit, d_limit, d_begin, d_stick, d_across, d_left, left
    real(wp) :: by_time, by_strength, along, across, d1, d2
    limit = e%share*s%strength
    d_limit = e%share*d_strength
    d_begin = e%across*d_angle
    d_across = -e%along*d_angle
    d_stick = 0
    if (e%stick > 0) then
      d_begin = 0
      if (e%begin > 0) d_begin = (limit*d_limit - e%across*d_across)/e%begin
      d_stick = (d_begin - e%across*d_angle)/e%stiffness
    end if
    call decay(s, s%time*(1 - e%stick/s%length), left, by_time, by_strength)
    d_left = by_time*s%time*(e%stick*d_length/s%length - d_stick)/s%length + by_strength*d_strength
    along = limit + (e%begin - limit)*left
    across = e%across*left
    d1 = d_limit + (d_begin - d_limit)*left + (e%begin - limit)*d_left
    d2 = d_across*left + e%across*d_left
    derivative = (d1 - across*d_angle)*s%along + (d2 + along*d_angle)*s%across
  end function

  ! An element above its limit, where nothing moves: it relaxes along its traction.
  pure subroutine rest(s, e, traction, by_strength)
    type(sliding), intent(in) :: s
    type(spring), intent(in) :: e
    real(wp), intent(inout) :: traction(2)
    real(wp), intent(out) :: by_strength(2)
    real(wp) :: limit, length, left, by_time, left_by_strength
    by_strength = 0
    limit = e%share*s%strength
    length = hypot(traction(1), traction(2))
    if (.not. length > limit) return
    call decay(s, s%time, left, by_time, left_by_strength)
    by_strength = (e%share*(1 - left) + (length - limit)*left_by_strength)/length*traction
    traction = (limit + (length - limit)*left)/length*traction
  end subroutine

  subroutine bristle( &
#include "usersub/bristle_names.fi"
      )
#include "usersub/bristle_types.fi"
    real(wp) :: per_time, length, mu, mu_by_rate, strength_by_length, by_strength(2)
    real(wp) :: by_length(2), by_angle(2)
    type(sliding) :: s
    type(spring) :: e
    logical :: slips
    integer :: n, i, b
    n = int(props(7))
    per_time = ratio(1.0_wp, time_increment)
    length = hypot(motion(1), motion(2))
    call stribeck(length*per_time, props(1), props(2), props(3), props(4), mu, mu_by_rate)
    strength_by_length = pressure*mu_by_rate*per_time
    s = sliding(length, [0.0_wp, 0.0_wp], [0.0_wp, 0.0_wp], time_increment, props(5), mu*pressure)
    if (length > 0) s%along = motion/length
    s%across = [-s%along(2), s%along(1)]

    traction = props(6)*per_time*motion
    if (present(tangent)) then
      tangent(1, 1) = props(6)*per_time
      tangent(2, 2) = props(6)*per_time
    end if
    do i = 1, n
      e = spring(props(7 + i), props(7 + n + i), 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp)
      slips = length > 0 .and. state(i) > 0
      by_strength = 0
      if (length > 0) then
        call move(s, motion, e, vectors(:, i), slips)
      else
        call rest(s, e, vectors(:, i), by_strength)
      end if
      state(i) = merge(1, 0, slips)
      traction = traction + vectors(:, i)
      if (.not. present(tangent)) cycle
      if (slips) then
        by_length = slip_derivative(s, e, 1.0_wp, 0.0_wp, strength_by_length)
        by_angle = slip_derivative(s, e, 0.0_wp, 1/length, 0.0_wp)
        by_strength = slip_derivative(s, e, 0.0_wp, 0.0_wp, 1.0_wp)
      end if
      do b = 1, 2
        if (slips) then
          tangent(:, b) = tangent(:, b) + by_length*s%along(b) + by_angle*s%across(b)
        else
          tangent(b, b) = tangent(b, b) + e%stiffness
        end if
      end do
      tangent(:, 3) = tangent(:, 3) + by_strength*mu
    end do
  end subroutine
end module

#include "usersub/bristle_law.fi"
