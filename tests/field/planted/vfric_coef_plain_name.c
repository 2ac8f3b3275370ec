/* SPDX-License-Identifier: MIT */
void vfric_coef(double *fCoef) {
  fCoef[0] = 1;
}
