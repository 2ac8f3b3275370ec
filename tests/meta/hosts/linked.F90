! SPDX-License-Identifier: MIT
! An explicit host of VFRIC in the plane, in Fortran, with the routine linked in: two masses slide on
! an analytical rigid line and turn back.
!
!     linked FAULT
!
! FAULT is the name of a rule that the host breaks, or "none".
program linked
  implicit none
  integer, parameter :: n = 2, wp = kind(1d0)
  external :: vfric
  ! The arguments, by their names: numbers, then what a node, a contact point and the host has.
  integer :: nContact = n, nDir = 2, nFricDir = 1, nFacNod = 0, nMainNod = 1, nSecNod = n
  integer :: nPred = 1, nProps = 1, nStateVar = 1, nTemp = 1, numDefTfv = 1
  integer :: kInc, kStep = 1, lContType = 0
  integer :: jConMainid(1, n) = 0, jConSecid(n) = [1, 2], jMainUid(1) = [99], jSecUid(n) = [11, 12]
  real(wp) :: areaSec(n), coordMain(2, 1), coordSec(2, n), statev(1, n)
  real(wp) :: dircosN(2, n), dirCosSl(2, n), dSlipFric(2, n), fNormal(n), fStickForce(n)
  real(wp) :: fTangential(1, n), fTangPrev(2, n), shape(1, n)
  real(wp) :: preDefMain(1, 1), preDefSec(n, 1), tempMain(1), tempSec(n)
  real(wp) :: dTimCur, timGlb, timStep, frictionWork, props(1)
  character(80) :: surfInt = 'RUBBER ON STEEL', surfMain = 'ROAD', surfSec = 'TREAD'
  character(40) :: fault
  real(wp) :: velocity(n), force(n), mass = 0.01_wp, side(n)
  integer :: i

  fault = 'none'
  if (command_argument_count() > 0) call get_command_argument(1, fault)
  velocity = [5._wp, -4._wp]
  force = 0
  statev = 0
  timGlb = 0
  frictionWork = 0
  coordMain = 0
  coordSec = 0
  coordSec(1, :) = [0._wp, 10._wp]
  shape = 0
  props = 0.2_wp
  areaSec = 0.5_wp
  fNormal = [2._wp, 3._wp]
  tempSec = 20
  tempMain = 25
  preDefSec = 1
  preDefMain = 1
  do kInc = 1, 30
    dTimCur = 1e-3_wp*(1 + 0.01_wp*kInc)
    timGlb = timGlb + dTimCur
    timStep = timGlb
    if (fault == 'host.times') timStep = timGlb - dTimCur
    side = sign(1._wp, velocity)
    dircosN(1, :) = 0
    dircosN(2, :) = 1
    dirCosSl(1, :) = side
    dirCosSl(2, :) = 0
    if (fault == 'host.axes') dirCosSl = reshape([side(1), side(2), 0._wp, 0._wp], [2, n])
    if (fault == 'host.slip-direction') dirCosSl = -dirCosSl
    dSlipFric(1, :) = abs(velocity)*dTimCur
    dSlipFric(2, :) = 0
    fStickForce = mass*abs(velocity)/dTimCur
    fTangPrev(1, :) = force*dirCosSl(1, :)
    fTangPrev(2, :) = 0
    if (fault == 'host.previous-force') fTangPrev(1, :) = abs(force)
    if (fault /= 'host.zeroed-outputs') fTangential = 0
    call vfric( &
#include "usersub/arguments/vfric_names.fi"
    if (fault == 'host.state') statev(1, 1) = statev(1, 2)
    force = fTangential(1, :)*side
    if (fault == 'host.slip-direction') force = -force
    coordSec(1, :) = coordSec(1, :) + velocity*dTimCur
    do i = 1, n
      ! A push turns them back now and then.
      velocity(i) = velocity(i) + (force(i) + 2*cos(0.4_wp*kInc + i))/mass*dTimCur
    end do
  end do
end program linked
