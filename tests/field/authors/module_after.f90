! SPDX-License-Identifier: MIT
! Free form: MODULE behind the routine that uses it, internal CONTAINS, select case, & on both lines, long lines, OPTIONAL
subroutine VFriction ( fTangential, state, nBlock, nBlockAnal, nBlockEdge, nNodState, nNodSec, nNodMain, nFricDir, nDir, nStates, nProps, nTemp, nFields, jFlags, rData, &
   surfInt, surfSec, surfMain, jConSecUid, jConMainUid, props, dSlipFric, fStickForce, fTangPrev, fNormal, areaCont, dircosN, dircosSl, shapeSec, shapeMain, coordSec, &
   & coordMain, velSec, velMain, tempSec, tempMain, fieldSec, fieldMain )
  use laws_of_mine, only : limit => smooth_limit
  include 'vaba_param.inc'
  character(len=80) :: surfInt, surfSec, surfMain
  dimension fTangential(nFricDir,nBlock), state(nStates,nNodState,nBlock), jFlags(3), rData(4), &
            props(nProps), dSlipFric(nDir,nBlock), fStickForce(nBlock), fNormal(nBlock), areaCont(nBlock), &
            tempSec(nBlock), tempMain(nBlockAnal), fieldSec(nFields,nBlock), fieldMain(nFields,nBlockAnal)
  real(kind(props)) :: mu
  do k = 1, nBlock
     ka = min(k, nBlockAnal)
     select case (trim(surfInt))
     case ('WET') ; mu = 0.5d0*props(1)
     case default ; mu = props(1)
     end select
     mu = mu * (1 + props(2)*(half_sum(tempSec(k), tempMain(ka)) - 20)) + &
          fieldSec(1,k) - fieldMain(2,ka)   ! it's "asymmetric"
     fTangential(1,k) = -min(mu*fNormal(k), fStickForce(k))
     state(1,1,k) = state(1,1,k) + limit(1.5d0)
  end do
contains
  function half_sum(a, b)
    half_sum = (a + b)/2
  end function half_sum
end subroutine VFriction

module laws_of_mine
  implicit none
contains
  pure function smooth_limit(x) result(y)
    real(8), intent(in) :: x
    real(8) :: y
    y = min(1.d0, x)
  end function
end module laws_of_mine
