# Lobes in the plane of measurement, log f_r as the radius: $curves, a group of rows (x, y) for each
# of `count`; $net, half circles and spokes (x, y); $rings (x, y, exponent of ten) and $spokes
# (x, y, angle / deg) for their labels; $incidence (x, y) on the outermost circle.
set terminal svg size 720,400 font "sans-serif,13" background "#ffffff"
set size ratio -1
set lmargin at screen 0.01
set rmargin at screen 0.88
set tmargin at screen 0.99
set bmargin at screen 0.01
set xrange [-1.2:1.2]
set yrange [-0.12:1.16]
unset border
unset tics
unset grid
plot NaN notitle, \
     $net using 1:2 with lines lc rgb "#dddddd" lw 1 dt solid notitle, \
     $rings using 1:2:(sprintf("10^{%d}", $3)) with labels offset 0,-0.7 font ",11" tc rgb "#444444" notitle, \
     $spokes using 1:2:(sprintf("%g", $3)) with labels font ",11" tc rgb "#444444" notitle, \
     for [i = 1:count] $incidence every ::(i - 1)::(i - 1) using 1:2:(-0.14 * $1):(-0.14 * $2) with vectors head filled size 0.04,20 lt i dt solid notitle, \
     for [i = 1:count] $curves index i - 1 using 1:2 with lines lt i title sprintf("%d", i)
