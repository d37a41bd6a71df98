# Openings in the plane of the receptor, to scale, in degrees from the nominal mirror direction:
# $bands, for each opening with limits its largest and its smallest edge; $outlines, an edge (in
# plane, perpendicular) for each of `count`; the window is `x_low` to `y_high`.
set terminal svg size 560,470 font "sans-serif,17" background "#ffffff"
set xlabel "in the plane of incidence / deg"
set ylabel "perpendicular to it / deg"
set size ratio -1
set xrange [x_low:x_high]
set yrange [y_low:y_high]
# The same steps of 1, 2 or 5 on both axes, far enough apart on the narrow one.
step = (y_high - y_low) / 7.0
power = 10.0 ** floor(log10(step))
step = step > 5 * power ? 10 * power : step > 2 * power ? 5 * power : step > power ? 2 * power : power
set xtics step
set ytics step
set key outside top center horizontal samplen 2.5 width 1
set style fill solid 1.0 noborder
plot NaN notitle, \
     for [i = 1:bands] $bands index i - 1 using 1:2 with filledcurves closed \
       fc rgb (i % 2 == 1 ? "#cfd8dc" : "#ffffff") notitle, \
     for [i = 1:count] $outlines index i - 1 using 1:2 with lines lt i lw 1.8 title sprintf("%d", i)
