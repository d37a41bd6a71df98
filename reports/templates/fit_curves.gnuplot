# Observations and fits: $values, groups of rows (abscissa, value), what was observed first and then
# each of `count` models; lines over wavelength, points over angles, where values span decades.
set xlabel is_spectrum ? "wavelength / nm" : "angle from the mirror direction / deg"
set ylabel is_spectrum ? "reflectance relative to a mirror" : "f_r / sr^{-1}"
set format y "%g"
set xrange [x_low:x_high]
set key off
if (is_spectrum) {
  set yrange [y_low:y_high]
  plot $values index 0 using 1:2 with points lt 1 pt 7 ps 0.4, \
       for [i = 1:count] $values index i using 1:2 with lines lt i + 1
} else {
  set logscale y
  set format y "10^{%T}"
  plot for [i = 0:count] $values index i using 1:2 with points lt i + 1 pt 7 ps 0.4
}
