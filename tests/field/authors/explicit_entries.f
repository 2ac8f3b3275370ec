c     SPDX-License-Identifier: MIT
c     VFRIC_COEF and VFRICTION beside VUMAT, VUAMP, VUSDFLD, VUFIELD, VEXTERNALDB; lower case; #include with double quotes
      subroutine vumat(nblock, ndir, nshr, nstatev, nfieldv, nprops, lanneal, stepTime, totalTime, dt, cmname, coordMp,
     1 charLength, props, density, strainInc, relSpinInc, tempOld, stretchOld, defgradOld, fieldOld, stressOld, stateOld,
     2 enerInternOld, enerInelasOld, tempNew, stretchNew, defgradNew, fieldNew, stressNew, stateNew, enerInternNew,
     3 enerInelasNew)
#include "vaba_param.inc"
      character*80 cmname
      dimension stressNew(nblock,ndir+nshr), stressOld(nblock,ndir+nshr), eigVal(maxblk,3)
      call vsprinc(nblock, stressOld, eigVal, ndir, nshr)
      stressNew(1,1) = eigVal(1,1)
      return
      end
      subroutine vusdfld(nblock, nstatev, nfieldv, nprops, ndir, nshr, jElem, kIntPt, kLayer, kSecPt, stepTime, totalTime,
     1 dt, cmname, coordMp, direct, T, charLength, props, stateOld, stateNew, field)
      include 'vaba_param.inc'
      character*80 cmname
      parameter( nrData=6 )
      character*3 cData(maxblk*nrData)
      dimension rData(maxblk*nrData), jData(maxblk*nrData)
      jStatus = 1
      call vgetvrm( 'PEEQ', rData, jData, cData, jStatus )
      if( jStatus .ne. 0 ) then
        call xplb_abqerr(-2,'Utility routine VGETVRM failed to get variable.',0,zero,' ')
        call xplb_exit
      end if
      end
      subroutine vuamp(ampName, time, ampValueOld, dt, nprops, props, nSvars, svars)
      include 'vaba_param.inc'
      character*80 ampName
      dimension time(2)
      time(1) = vGetSensorValue('X')
      end
      subroutine vfric_coef(fCoef, fCoefDeriv, nBlock, nProps, nTemp, nFields, jFlags, rData, surfInt, surfSlv, surfMst,
     * props, slipRate, pressure, tempAvg, fieldAvg)
#include "vaba_param.inc"
      dimension fCoef(nBlock), fCoefDeriv(nBlock,3), props(nProps), slipRate(nBlock), pressure(nBlock), tempAvg(nBlock),
     * fieldAvg(nBlock,*), jFlags(2), rData(3)
      character*80 surfInt, surfSlv, surfMst
      do k = 1, nBlock
        fCoef(k) = smooth(slipRate(k), props) * (1.d0 + 0.1d0*fieldAvg(k,2))
      enddo
      end
      function smooth(v, props)
      include 'vaba_param.inc'
      dimension props(3)
      smooth = props(2) + (props(1) - props(2))*exp(-props(3)*v)
      end
      subroutine vfriction(fTangential,state,nBlock,nBlockAnal,nBlockEdge,nNodState,nNodSlv,nNodMst,nFricDir,nDir,nStates,
     1 nProps,nTemp,nFields,jFlags,rData,surfInt,surfSlv,surfMst,jConSlvUid,jConMstUid,props,dSlipFric,fStickForce,fTangPrev,
     2 fNormal,areaCont,dircosN,dircosSl,shapeSlv,shapeMst,coordSlv,coordMst,velSlv,velMst,tempSlv,tempMst,fieldSlv,fieldMst)
      include 'VABA_PARAM.INC'
      character*80 surfInt, surfSlv, surfMst
      dimension fTangential(nFricDir,nBlock), dSlipFric(nDir,nBlock), fStickForce(nBlock), fNormal(nBlock), rData(*),
     1 props(nProps), fieldSlv(nFields,nBlock), fieldMst(nFields,nBlockAnal)
      do k = 1, nBlock
        v = sqrt(dSlipFric(1,k)**2 + dSlipFric(2,k)**2 + dSlipFric(3,k)**2)/rData(3)
        xmu = smooth(v, props)*(1.d0 + 0.05d0*(fieldSlv(2,k) + fieldMst(2,min(k,nBlockAnal))))
        fTangential(1,k) = -min(xmu*fNormal(k), fStickForce(k))
      enddo
      end
      subroutine vufield(field, nBlock, nField, kField, nComp, kStep, jFlags, jNodeid, time, coords, u, v, a)
      include 'vaba_param.inc'
      dimension field(nBlock,nComp,nField)
      field = 0
      end
      subroutine vexternaldb(lOp, i_Array, niArray, r_Array, nrArray)
      include 'vaba_param.inc'
      end
