C     SPDX-License-Identifier: MIT
C     Coulomb friction with elastic stick. Old style: upper case, 8-character names, PREDEF(*),
C     SPD for the dissipation; don't forget: lines end where a card ended.
      SUBROUTINE FRIC(LM,TAU,DDTDDG,DDTDDP,DSLIP,SED,SPD,
     1 DDTDDT,PNEWDT,STATEV,DGAM,TAULM,PRESS,DPRESS,DDPDDH,SLIP,
     2 KSTEP,KINC,TIME,DTIME,NOEL,CINAME,SLNAME,MSNAME,NPT,NODE,
     3 NPATCH,COORDS,RCOORD,DROT,TEMP,PREDEF,NFDIR,MCRD,NPRED,
     4 NSTATV,CHRLNGTH,PROPS,NPROPS)
C
      INCLUDE 'ABA_PARAM.INC'
C
      CHARACTER*8 CINAME,SLNAME,MSNAME
      CHARACTER*80 CPNAME
      DIMENSION TAU(NFDIR),DDTDDG(NFDIR,NFDIR),DDTDDP(NFDIR),
     1 DSLIP(NFDIR),DDTDDT(NFDIR,2),STATEV(*),DGAM(NFDIR),
     2 TAULM(NFDIR),SLIP(NFDIR),TIME(2),COORDS(MCRD),RCOORD(MCRD),
     3 DROT(2,2),TEMP(2),PREDEF(*),PROPS(NPROPS)
      PARAMETER (ZERO=0.D0, ONE=1.D0)
C
      IF (LM .EQ. 2) RETURN
      IF (NPROPS .LT. 2) THEN
         WRITE(7,*) 'FRIC NEEDS TWO PROPERTIES, GOT ', NPROPS
         CALL XIT
      END IF
      LM = 0
      XMU = PROPS(1)
      XK = PROPS(2)
C     Local number of the node: the part instance is not needed.
      CALL GETPARTINFO(NODE, 0, CPNAME, LOCNUM, JRCD)
      IF (JRCD .NE. 0) LOCNUM = NODE
      TAUCR = XMU*PRESS
      DO 20 K1 = 1, NFDIR
         TRIAL = TAU(K1) + XK*DGAM(K1)
         IF (ABS(TRIAL) .LE. TAUCR) THEN
            TAU(K1) = TRIAL
            DDTDDG(K1,K1) = XK
            DDTDDP(K1) = ZERO
            DSLIP(K1) = ZERO
         ELSE
            DSLIP(K1) = (TRIAL - SIGN(TAUCR,TRIAL))/XK
            TAU(K1) = SIGN(TAUCR,TRIAL)
            DDTDDG(K1,K1) = ZERO
            DDTDDP(K1) = SIGN(XMU,TRIAL)
         END IF
         SPD = SPD + TAU(K1)*DSLIP(K1)
   20 CONTINUE
      IF (CINAME .EQ. 'GREASED') TAU(1) = ZERO
      RETURN
      END
