! SPDX-License-Identifier: MIT
! Two coefficients: the critical stress is an ellipse, to which the trial stress is projected.
! props: 0.4, 0.2, 1000
  SUBROUTINE FRIC(LM,TAU,DDTDDG,DDTDDP,DSLIP,SED,SFD,DDTDDT,PNEWDT, &
   STATEV,DGAM,TAULM,PRESS,DPRESS,DDPDDH,SLIP,KSTEP,KINC,TIME,DTIME, &
   NOEL,CINAME,SLNAME,MSNAME,NPT,NODE,NPATCH,COORDS,RCOORD,DROT, &
   TEMP,PREDEF,NFDIR,MCRD,NPRED,NSTATV,CHRLNGTH,PROPS,NPROPS)
  INCLUDE 'ABA_PARAM.INC'
  CHARACTER*80 CINAME,SLNAME,MSNAME
  DIMENSION TAU(NFDIR),DDTDDG(NFDIR,NFDIR),DDTDDP(NFDIR), &
   DSLIP(NFDIR),DDTDDT(NFDIR,2),STATEV(*),DGAM(NFDIR), &
   TAULM(NFDIR),SLIP(NFDIR),TIME(2),COORDS(MCRD),RCOORD(MCRD), &
   DROT(2,2),TEMP(2),PREDEF(2,*),PROPS(NPROPS)
  integer i, j, it
  double precision trial(2), w(2), xl, f, df, dl, r(2), jac(2,2), nrm
  if (lm == 2) return
  lm = 0
  xk = props(3)
  ddtddt = 0; ddtddp = 0; ddtddg = 0; dslip = 0
  trial = 0
  trial(1:nfdir) = tau + xk*dgam
  p = max(press, 0d0)
  if (p == 0) then
    tau = 0; sed = 0; sfd = 0
    dslip = dgam
    return
  end if
  w(1) = 1/(props(1)*p)**2
  w(2) = 1/(props(2)*p)**2
  f = sum(w*trial**2)
  if (f <= 1) then
    tau = trial(1:nfdir)
    do i = 1, nfdir
      ddtddg(i,i) = xk
    end do
    sfd = 0
    sed = sum(trial**2)/(2*xk)
    return
  end if
  ! tau_i = trial_i/(1 + xl w_i): closest point on the ellipse
  xl = 0
  do it = 1, 100
    f = sum(w*(trial/(1 + xl*w))**2) - 1
    df = -2*sum(w**2*trial**2/(1 + xl*w)**3)
    dl = -f/df
    xl = xl + dl
    if (abs(dl) <= 1d-14*xl) exit
  end do
  r = trial/(1 + xl*w)
  df = -2*sum(w**2*trial**2/(1 + xl*w)**3)
  do i = 1, nfdir
    do j = 1, nfdir
      ! d xl/d trial_j = -(2 w_j trial_j/(1+xl w_j)^2)/df
      ddtddg(i,j) = xk*(r(i)*w(i)/(1 + xl*w(i)))*(2*w(j)*r(j)/(1 + xl*w(j)))/df
    end do
    ddtddg(i,i) = ddtddg(i,i) + xk/(1 + xl*w(i))
  end do
  ! by pressure: dw = -2w/p
  f = sum(r**2*(-2*w/p) - 2*w*r**2/(1 + xl*w)*xl*(-2*w/p))
  dl = -f/df
  do i = 1, nfdir
    ddtddp(i) = -r(i)/(1 + xl*w(i))*(dl*w(i) + xl*(-2*w(i)/p))
  end do
  tau = r(1:nfdir)
  dslip = (trial(1:nfdir) - tau)/xk
  sed = sum(tau**2)/(2*xk)
  sfd = sum(tau*dslip)
end subroutine
