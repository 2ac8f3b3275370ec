! SPDX-License-Identifier: MIT
! An explicit host in Fortran: a rigid block slides on a rigid plane until friction stops it.
!
!     explicit_block_fortran LIBRARY INTERFACE [PROPERTY ...]
!
! LIBRARY is a shared library with the user's routine, INTERFACE is vfric, vfriction or vfric_coef.
! The block is 5 in x 1 in x 1 in, of density 7.3e-4 lb s^2/in^4, under a pressure of 2000 psi, and
! starts at 200 in/s. It rests on five contact points of 1 in^2 each.
!
! Built against an installed usersub with CMake (see ../CMakeLists.txt), or in one line, the module
! being compiled along, since module files belong to one compiler:
!     gfortran $(pkg-config --variable=fortran_module usersub) explicit_block.f90 \
!         -o explicit_block_fortran $(pkg-config --libs usersub)
program explicit_block
  use, intrinsic :: iso_fortran_env, only: error_unit
  use usersub
  implicit none
  integer, parameter :: wp = c_double, n = 5
  real(wp), parameter :: mass = 7.3e-4_wp * n, start_speed = 200, dt = 1e-6_wp

  ! What the host keeps at its contact points. Bound arrays need the target attribute.
  real(wp), target :: slip_increment(3, n), velocity(3, n), normal(3, n), coord(3, n), force(3, n)
  real(wp), target :: normal_force(n), stick_force(n), area(n), point_mass(n)
  integer(c_int32_t), target :: node(n)

  type(usub_routine) :: routine
  type(usub_scene) :: scene
  type(usub_driver) :: driver
  type(usub_error), target :: error
  character(:), allocatable :: library, interface
  real(wp), allocatable :: props(:)
  real(wp) :: time, distance, speed, change, deceleration
  integer :: i

  call read_arguments
  velocity = 0
  slip_increment = 0
  coord = 0
  normal = 0
  normal(3, :) = 1
  area = 1
  normal_force = 2000 * area
  point_mass = mass / n
  node = [(i, i=1, n)]
  call prepare

  time = 0
  distance = 0
  speed = start_speed
  deceleration = 0
  do i = 1, 100000
    change = -total_force(i) / mass * dt
    ! The stick force bounds the friction: it stops the block within this increment.
    if (speed - change <= 1e-9_wp * start_speed) exit
    distance = distance + (speed - change / 2) * dt
    time = time + dt
    speed = speed - change
    deceleration = change / dt
  end do
  ! The rest of the way, at the deceleration of the last full increment.
  time = time + speed / deceleration
  distance = distance + speed**2 / (2 * deceleration)
  print '(3a, es22.16, a, es22.16)', 'host=fortran interface=', interface, ' stop_time=', time, &
    ' stop_distance=', distance

  call usub_driver_free(driver)
  call usub_scene_free(scene)
  call usub_routine_free(routine)
  deallocate (library, interface, props) ! a main program's own are kept otherwise

contains
  ! Text for C ends in a NUL character.
  pure function c(text)
    character(*), intent(in) :: text
    character(len(text) + 1) :: c
    c = text//c_null_char
  end function c

  ! All that a host has to do about errors: stop at the first negative status, show the message.
  subroutine check(status, message)
    integer(c_int32_t), intent(in) :: status
    type(c_ptr), intent(in) :: message
    if (status >= 0) return
    write (error_unit, '(3a)') usub_string(usub_status_name(status)), ': ', usub_string(message)
    stop 1
  end subroutine check

  ! Routine, scene and driver; arrays are bound once and read in every step.
  subroutine prepare
    call check(usub_check_abi(c(usub_module_abi_hash), error), c_loc(error%message))
    call check(usub_routine_open(c(library), c(interface), precision=c('double'), &
                                 routine=routine, error=error), c_loc(error%message))
    ! The scene says what this host has. Whatever it does not mention, it does not have.
    call check(usub_scene_create(scene), c_null_ptr)
    call check(usub_scene_set_int(scene, c('points'), n), usub_scene_message(scene))
    call check(usub_scene_set_int(scene, c('secondary_nodes'), n), usub_scene_message(scene))
    call check(usub_scene_set_int(scene, c('nodes'), n), usub_scene_message(scene))
    call check(usub_scene_set_text(scene, c('contact'), c('analytical-rigid')), &
               usub_scene_message(scene))
    call check(usub_scene_set_props(scene, props, size(props)), usub_scene_message(scene))
    call check(usub_driver_create(c('explicit'), routine, scene, driver, error), &
               c_loc(error%message))
    call bind('slip_increment', c_loc(slip_increment), size(slip_increment))
    call bind('normal', c_loc(normal), size(normal))
    call bind('normal_force', c_loc(normal_force), n)
    call bind('stick_force', c_loc(stick_force), n)
    call bind('area', c_loc(area), n)
    call bind('secondary_node', c_loc(node), n)
    call bind('force', c_loc(force), size(force))
    if (interface == 'vfric') call bind('coord_secondary', c_loc(coord), size(coord))
    if (interface == 'vfriction') call bind('coord', c_loc(coord), size(coord))
    if (interface == 'vfriction') call bind('velocity', c_loc(velocity), size(velocity))
  end subroutine prepare

  subroutine bind(array, address, count)
    character(*), intent(in) :: array
    type(c_ptr), intent(in) :: address
    integer, intent(in) :: count
    call check(usub_bind(driver, c(array), address, int(count, c_size_t)), usub_message(driver))
  end subroutine bind

  ! Friction force of one increment, summed over the points.
  function total_force(increment)
    integer, intent(in) :: increment
    real(wp) :: total_force, now
    now = increment * dt
    coord(1, :) = 0.5_wp + node - 1 + distance
    velocity(1, :) = speed
    slip_increment(1, :) = speed * dt ! without friction
    call check(usub_stick_force_kinematic(n, 3, velocity, normal, point_mass, dt, stick_force), &
               c_null_ptr)
    call check(usub_set_time(driver, 1, increment, now, now, dt), usub_message(driver))
    call check(usub_step(driver), usub_message(driver))
    total_force = sum(force(1, :))
  end function total_force

  subroutine read_arguments
    character(1000) :: word
    integer :: i
    if (command_argument_count() < 2) error stop 'usage: LIBRARY INTERFACE [PROPERTY ...]'
    call get_command_argument(1, word)
    library = trim(word)
    call get_command_argument(2, word)
    interface = trim(word)
    props = [(0.15_wp, i=3, max(3, command_argument_count()))]
    do i = 3, command_argument_count()
      call get_command_argument(i, word)
      read (word, *) props(i - 2)
    end do
  end subroutine read_arguments
end program explicit_block
