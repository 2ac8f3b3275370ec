! SPDX-License-Identifier: MIT
! Elasto-plastic friction: LuGre with a bristle that is elastic up to its breakaway;
! props: mus, muk, vs, delta, sigma0, sigma1, sigma2, breakaway.
! While the bristle slips in part, its bend is told by the gap, what it lacks to its limit, and the
! angle from the motion to the bend; lengths are in units of the limit.
#define USUB_LAW 'elasto_plastic'
#define USUB_LAW_PROPS 8
#define USUB_LAW_VECTORS 1
#define USUB_LAW_READS_PRESSURE
#define USUB_LAW_READS_TIME
#include "usersub/laws.fi"
#include "usersub/law_functions.fi"

module usub_law_function
  use usub_law_tools
  use usub_law_functions
  implicit none
  private
  public :: bristle

  real(wp), parameter :: pi = 3.14159265358979323846_wp
  ! Least breakaway: below, the bend where slip begins is lost in rounding.
  real(wp), parameter :: least = merge(1e-12_wp, 1e-5_wp, precision(1.0_wp) > 10)

  ! Weights that remove the errors of midpoint sums of 2, 4, ... 12 parts up to the order 12.
  real(wp), parameter :: weights(6) = [-1/302400.0_wp, 8/945.0_wp, -2187/4480.0_wp, &
      65536/14175.0_wp, -9765625/798336.0_wp, 17496/1925.0_wp]

  ! One motion: bend at the beginning, along the motion and across it; motion that bends it
  ! elastically before it slips, and how much of the bend it leads to; the end: gap and angle; their
  ! derivatives by the gap at the beginning; those by the direction of the motion, of the angle in
  ! space, which are small where the motion is.
  type :: path
    real(wp) :: along, across, motion, width, reach, stick, y(6), slack, slope
    logical :: slips, clipped
  end type

  ! What one variable changes: bend at the beginning, motion and its direction, limit, slip rate.
  type :: change
    real(wp) :: along, across, motion, angle, limit, rate
  end type
contains
  ! One less alpha times the bend: how much of a motion along the bend bends it further.
  pure subroutine slack_of(gap, width, slack, slope)
    real(wp), intent(in) :: gap, width
    real(wp), intent(out) :: slack, slope
    real(wp) :: s, c
    s = sin(pi/2*gap/width)
    c = cos(pi/2*gap/width)
    slack = s**2 + c**2*gap
    slope = pi/width*s*c*(1 - gap) + c**2
  end subroutine

  ! Derivatives by the motion.
  pure function flow(y, width) result(rate)
    real(wp), intent(in) :: y(:), width
    real(wp) :: rate(size(y)), slack, slope, bend, s, c, angle
    integer :: j
    call slack_of(y(1), width, slack, slope)
    bend = 1 - y(1)
    s = sin(y(2))
    c = cos(y(2))
    rate(1) = -c*slack
    rate(2) = -s/bend
    do j = 3, size(y), 2
      angle = y(j + 1)
      if (j == 5) angle = angle - 1
      rate(j) = -c*slope*y(j) + s*slack*angle
      rate(j + 1) = -s/bend/bend*y(j) - c/bend*angle
    end do
  end function

  ! Motion over which the bend changes little.
  pure function safe_step(gap, angle, width)
    real(wp), intent(in) :: gap, angle, width
    real(wp) :: safe_step, turn, fall
    turn = abs(sin(angle))
    fall = pi/2/width*min(1.0_wp, pi*abs(gap)/width)
    safe_step = 0.5_wp/(1 + fall*abs(cos(angle)) + sqrt(fall*turn) + (1 + 2*sqrt(turn))/(1 - gap))
  end function

  ! After a motion: extrapolated midpoint sums; a long motion ends in steady slip, exp(-40) away.
  pure subroutine approach(y, motion, width)
    real(wp), intent(inout) :: y(:)
    real(wp), intent(in) :: motion, width
    real(wp), dimension(size(y)) :: before, here, after, total
    real(wp) :: left, step, part
    integer :: j, k
    if (motion > 40) then
      y = 0
      if (size(y) == 6) y(6) = 1
      return
    end if
    left = motion
    do while (left > 0)
      step = min(safe_step(y(1), y(2), width), left)
      total = 0
      do j = 1, 6
        part = step/(2*j)
        before = y
        here = y + part*flow(y, width)
        do k = 2, 2*j
          after = before + 2*part*flow(here, width)
          before = here
          here = after
        end do
        total = total + weights(j)*(here - y)
      end do
      y = y + total
      left = left - step
    end do
  end subroutine

  pure subroutine follow(p, numbers)
    type(path), intent(inout) :: p
    integer, intent(in) :: numbers
    real(wp) :: breakaway, begin
    breakaway = 1 - p%width
    p%reach = 0
    if (abs(p%across) < breakaway) p%reach = sqrt((breakaway - p%across)*(breakaway + p%across))
    p%stick = max(p%reach - p%along, 0.0_wp)
    p%slips = .not. p%motion < p%stick
    if (.not. p%slips) return
    begin = max(p%reach, p%along)
    p%y = [1 - hypot(begin, p%across), atan2(p%across, begin), 1.0_wp, 0.0_wp, 0.0_wp, 0.0_wp]
    call approach(p%y(1:numbers), p%motion - p%stick, p%width)
    call slack_of(p%y(1), p%width, p%slack, p%slope)
  end subroutine

  ! Bend at the end, and how it changes with further motion.
  pure subroutine end_of(p, bend, speed)
    type(path), intent(in) :: p
    real(wp), intent(out) :: bend(2), speed(2)
    real(wp) :: s, c
    s = sin(p%y(2))
    c = cos(p%y(2))
    bend = (1 - p%y(1))*[c, s]
    speed = [s*s + p%slack*c*c, -(1 - p%slack)*s*c]
  end subroutine

  ! Changes of gap and of angle in space at the beginning of the slip, and of the motion before.
  pure subroutine begin_change(p, d, gap, angle, stick)
    type(path), intent(in) :: p
    type(change), intent(in) :: d
    real(wp), intent(out) :: gap, angle, stick
    real(wp) :: square
    gap = 0
    stick = 0
    if (p%stick > 0 .and. p%reach > 0) then
      angle = (d%across + p%stick*d%angle)/p%reach
      stick = -p%across*angle - d%along
    else if (p%stick > 0) then ! the bend is beyond the breakaway and has turned to the side
      gap = -sign(1.0_wp, p%across)*(d%across + p%stick*d%angle)
      angle = d%angle
      stick = -d%along - p%across*d%angle
    else
      square = p%along**2 + p%across**2
      if (.not. p%clipped) gap = -(p%along*d%along + p%across*d%across)/sqrt(square)
      angle = (p%along*d%across - p%across*d%along)/square
    end if
  end subroutine

  ! Changes of bend (times the limit) and of the velocity at the end.
  pure subroutine end_change(p, d, limit, rate, d_bend, d_velocity)
    type(path), intent(in) :: p
    type(change), intent(in) :: d
    real(wp), intent(in) :: limit, rate
    real(wp), intent(out) :: d_bend(2), d_velocity(2)
    real(wp) :: bend(2), speed(2), s, c, gap, angle, stick, moved(2)
    call end_of(p, bend, speed)
    call begin_change(p, d, gap, angle, stick)
    s = sin(p%y(2))
    c = cos(p%y(2))
    moved = p%y(3:4)*gap + p%y(5:6)*(d%angle - angle) + [0.0_wp, angle] &
        - [c*p%slack, s/(1 - p%y(1))]*merge(0.0_wp, d%motion - stick, p%motion - p%stick > 40)
    d_bend = limit*(-moved(1)*[c, s] + (1 - p%y(1))*moved(2)*[-s, c]) + d%limit*bend
    d_velocity = [2*s*c, s*s - c*c]*(1 - p%slack)*(moved(2) - d%angle) + [c, s]*c*p%slope*moved(1)
    d_velocity = rate*(d_velocity + d%angle*[-speed(2), speed(1)]) + d%rate*speed
  end subroutine

  ! Where nothing moves: what a motion would change, by each component from above.
  pure function at_rest(bend, width) result(by_motion)
    real(wp), intent(in) :: bend(2), width
    real(wp) :: by_motion(2, 2), length, slack, slope, held
    integer :: b
    length = hypot(bend(1), bend(2))
    held = 0
    if (length > 0 .and. 1 - length <= width) then
      call slack_of(1 - length, width, slack, slope)
      held = (1 - slack)/length/length
    end if
    do b = 1, 2
      by_motion(:, b) = -held*bend*max(bend(b), 0.0_wp)
      by_motion(b, b) = by_motion(b, b) + 1
    end do
  end function

  subroutine bristle( &
#include "usersub/bristle_names.fi"
      )
#include "usersub/bristle_types.fi"
    real(wp) :: per_time, length, rate, mu, mu_by_rate, limit, by_length, share, n(2), t(2), first(2)
    real(wp) :: bend(2), speed(2), d_bend(2), d_velocity(2), d_traction(2)
    logical :: clipped
    type(path) :: p
    type(change) :: d(3)
    integer :: k
    associate (stiffness => props(5), damping => props(6), z => vectors(:, 1), &
        width => 1 - max(props(8), least))
      per_time = ratio(1.0_wp, time_increment)
      length = hypot(motion(1), motion(2))
      rate = length*per_time
      call stribeck(rate, props(1), props(2), props(3), props(4), mu, mu_by_rate)
      limit = pressure*mu/stiffness
      traction = props(7)*per_time*motion
      if (present(tangent)) then
        tangent(1, 1) = props(7)*per_time
        tangent(2, 2) = props(7)*per_time
      end if
      n = 0
      if (length > 0) n = motion/length
      t = [-n(2), n(1)]
      if (.not. limit > tiny(limit)) then ! the bristle carries nothing, but it will with the pressure
        z = 0
        if (present(tangent)) tangent(:, 3) = mu*n
        return
      end if
      ! A bend beyond a limit that has fallen goes back to it.
      clipped = hypot(z(1), z(2)) > limit
      first = z/max(hypot(z(1), z(2)), limit)
      by_length = limit*mu_by_rate*per_time/mu ! of the limit
      if (.not. length > 0) then
        z = limit*first
        traction = traction + stiffness*z
        if (present(tangent)) then
          tangent(:, 1:2) = tangent(:, 1:2) + (stiffness + damping*per_time)*at_rest(first, width)
          if (clipped) then
            tangent(:, 1) = tangent(:, 1) + stiffness*by_length*first
            tangent(:, 2) = tangent(:, 2) + stiffness*by_length*first
            tangent(:, 3) = mu*first
          end if
        end if
        return
      end if

      p%along = dot_product(first, n)
      p%across = dot_product(first, t)
      p%motion = length/limit
      p%width = width
      p%clipped = clipped
      call follow(p, merge(6, 2, present(tangent)))
      if (.not. p%slips) then
        if (clipped) z = limit*first
        z = z + motion
        traction = traction + stiffness*z + damping*per_time*motion
        if (present(tangent)) then
          tangent(1, 1) = tangent(1, 1) + stiffness + damping*per_time
          tangent(2, 2) = tangent(2, 2) + stiffness + damping*per_time
          if (clipped) then
            tangent(:, 1) = tangent(:, 1) + stiffness*by_length*first*n(1)
            tangent(:, 2) = tangent(:, 2) + stiffness*by_length*first*n(2)
            tangent(:, 3) = mu*first
          end if
        end if
        return
      end if
      call end_of(p, bend, speed)
      z = limit*(bend(1)*n + bend(2)*t)
      traction = traction + stiffness*z + damping*rate*(speed(1)*n + speed(2)*t)
      if (.not. present(tangent)) return
      ! by the length of the motion, by its angle and by the pressure
      share = merge(0.0_wp, 1/limit, clipped)
      d(1) = change(-share*p%along*by_length, -share*p%across*by_length, &
          (1 - p%motion*by_length)/limit, 0.0_wp, by_length, per_time)
      d(2) = change(0.0_wp, 0.0_wp, 0.0_wp, 1/length, 0.0_wp, 0.0_wp)
      d(3) = change(-share*p%along*limit/pressure, -share*p%across*limit/pressure, &
          -p%motion/pressure, 0.0_wp, limit/pressure, 0.0_wp)
      do k = 1, 3
        call end_change(p, d(k), limit, rate, d_bend, d_velocity)
        d_bend = stiffness*d_bend + damping*d_velocity
        d_traction = d_bend(1)*n + d_bend(2)*t
        if (k == 1) then
          tangent(:, 1) = tangent(:, 1) + d_traction*n(1)
          tangent(:, 2) = tangent(:, 2) + d_traction*n(2)
        else if (k == 2) then
          tangent(:, 1) = tangent(:, 1) + d_traction*t(1)
          tangent(:, 2) = tangent(:, 2) + d_traction*t(2)
        else
          tangent(:, 3) = d_traction
        end if
      end do
    end associate
  end subroutine
end module

#include "usersub/bristle_law.fi"
