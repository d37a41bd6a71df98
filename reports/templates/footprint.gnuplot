# What a receptor sees, in degrees from the nominal mirror direction: $lobe, a matrix of relative
# radiance with its angles in the first row and column (`has_lobe`, else it is empty); $outlines, a
# group of rows (in plane, perpendicular) for each of `count`; the window is `x_low` to `y_high`.
set terminal svg size 560,520 font "sans-serif,13" background "#ffffff"
set xlabel "in the plane of incidence / deg"
set ylabel "perpendicular to it / deg"
set size ratio -1
set xrange [x_low:x_high]
set yrange [y_low:y_high]
set cbrange [0:1]
set cblabel "radiance of the sample, relative"
set palette defined (0 "#ffffff", 0.5 "#d9d2c3", 1 "#a89f8a")
if (has_lobe) {
  set contour base
  set cntrparam levels discrete 0.1, 0.25, 0.5, 0.75, 0.9
  unset surface
  set table $contours
  splot $lobe nonuniform matrix
  unset table
  unset contour
  set surface
  plot $lobe nonuniform matrix with image notitle, \
       $contours using 1:2 with lines lc rgb "#7a7a7a" lw 0.7 dt solid notitle, \
       for [i = 1:count] $outlines index i - 1 using 1:2 with lines lt i title sprintf("%d", i)
} else {
  plot NaN notitle, for [i = 1:count] $outlines index i - 1 using 1:2 with lines lt i title sprintf("%d", i)
}
