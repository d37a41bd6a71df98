# RMSE over the diameters of source and receptor: $map, rows (source / deg, receptor / deg, RMSE);
# `most`, the largest of them. The line is where both are equal.
set terminal svg size 560,470 font "sans-serif,15" background "#ffffff"
set xlabel "diameter of the source / deg"
set ylabel "diameter of the receptor / deg"
set xrange [x_low:x_high]
set yrange [y_low:y_high]
unset key
unset grid
set cbrange [0:most]
set format cb "%.2g"
set palette defined (0 "#ffffff", 1 "#e08214")
plot NaN notitle, x with lines lc rgb "#888888" dt (6,4) lw 1 notitle, \
     $map using 1:2:3 with points pt 5 ps 3 palette notitle, \
     $map using 1:2:(sprintf("%.4f", $3)) with labels offset 0,1.1 font ",11" notitle
