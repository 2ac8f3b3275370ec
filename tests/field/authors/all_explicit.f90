! SPDX-License-Identifier: MIT
! No include at all: IMPLICIT NONE, every argument declared with kinds and INTENT, derived type, ASSOCIATE, BLOCK, SPREAD
subroutine vfriction(fTangential,state,nBlock,nBlockAnal,nBlockEdge,nNodState,nNodSec,nNodMain,nFricDir,nDir,nStates,nProps, &
    nTemp,nFields,jFlags,rData,surfInt,surfSec,surfMain,jConSecUid,jConMainUid,props,dSlipFric,fStickForce,fTangPrev,fNormal, &
    areaCont,dircosN,dircosSl,shapeSec,shapeMain,coordSec,coordMain,velSec,velMain,tempSec,tempMain,fieldSec,fieldMain)
  use, intrinsic :: iso_fortran_env, only: dp => real64, i4 => int32
  implicit none
  integer(i4), intent(in) :: nBlock,nBlockAnal,nBlockEdge,nNodState,nNodSec,nNodMain,nFricDir,nDir,nStates,nProps,nTemp,nFields
  integer(i4), intent(in) :: jFlags(3), jConSecUid(nNodSec,nBlock), jConMainUid(nNodMain,nBlockAnal)
  character(len=80), intent(in) :: surfInt,surfSec,surfMain
  real(dp), intent(out) :: fTangential(nFricDir,nBlock)
  real(dp), intent(inout) :: state(nStates,nNodState,nBlock)
  real(dp), intent(in) :: rData(4), props(nProps)
  real(dp), intent(in), dimension(nDir,nBlock) :: dSlipFric,fTangPrev,dircosN,dircosSl
  real(dp), intent(in), dimension(nBlock) :: fStickForce,fNormal,areaCont,tempSec
  real(dp), intent(in) :: shapeSec(nNodSec,nBlockEdge), shapeMain(nNodMain,nBlockAnal)
  real(dp), intent(in) :: coordSec(nDir,nNodSec,nBlock), coordMain(nDir,nNodMain,nBlockAnal)
  real(dp), intent(in) :: velSec(nDir,nNodSec,nBlock), velMain(nDir,nNodMain,nBlockAnal)
  real(dp), intent(in) :: tempMain(nBlockAnal), fieldSec(nFields,nBlock), fieldMain(nFields,nBlockAnal)
  type law
    real(dp) :: mu = 0, cohesion = 0
  end type law
  type(law) :: mine
  integer(i4) :: k
  mine = law(props(1), props(2))
  do k = 1, nBlock
    associate (a => areaCont(k), n => fNormal(k))
      block
        real(dp) :: ft
        ft = mine%mu*n + mine%cohesion*a
        if (n <= 0.0_dp) ft = 0
        fTangential(:,k) = [ -min(ft, fStickForce(k)), spread(0.0_dp, 1, nFricDir-1) ]
      end block
      state(1,1,k) = state(1,1,k) + abs(fTangential(1,k))*norm2(dSlipFric(:,k))
    end associate
  end do
end subroutine vfriction
