# Deviations over a ladder of samples: $readings, rows (number of the sample, deviation / GU, U / GU);
# `samples` is how many samples there are.
set terminal svg size 560,350 font "sans-serif,17" background "#ffffff"
set xlabel "sample, from matt to mirror"
set ylabel "deviation and U / GU"
set xrange [0.5:samples + 0.5]
set xtics 1
set yrange [y_low:y_high]
set format y "%g"
# A mirror deviates by a hundred times as much as a paint: the axis is linear about zero, and
# logarithmic far from it.
set nonlinear y via asinh(y / 0.1) inverse 0.1 * sinh(y)
set ytics (-100, -10, -1, -0.1, 0, 0.1, 1, 10, 100)
set grid ytics
unset key
plot NaN notitle, $readings using 1:($2 - $3):($2 + $3) with filledcurves fc rgb "#d6e4ef" fs solid 1.0 notitle, \
     0 with lines lc rgb "#444444" lw 1 dt solid notitle, \
     $readings using 1:2:3 with yerrorbars lt 1 lw 2 ps 0.7 notitle
