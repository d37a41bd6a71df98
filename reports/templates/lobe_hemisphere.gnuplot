# A hemisphere seen from above, polar angle as the radius: $map, rows (x, y, log10 of f_r) of a grid,
# scan lines apart by blank lines; $net, circles and spokes (x, y); $rings (x, y, polar angle / deg,
# colour) for labels; $marks (x, y): where a mirror sends the light; `low` and `high` exponents of ten.
set terminal svg size 560,460 font "sans-serif,14" background "#ffffff"
set view map
set lmargin at screen 0.01
set rmargin at screen 0.83
set tmargin at screen 0.99
set bmargin at screen 0.01
set size ratio -1
set xrange [-1.12:1.12]
set yrange [-1.12:1.12]
unset border
unset tics
unset grid
unset key
set pm3d map corners2color mean
set palette defined (0 "#000004", 1 "#3b0f70", 2 "#8c2981", 3 "#de4968", 4 "#fe9f6d", 5 "#fcfdbf")
set cbrange [low:high]
set cbtics 1
set format cb "10^{%.0f}"
set colorbox user origin 0.88,0.2 size 0.03,0.6
splot $map using 1:2:3 with pm3d notitle, \
      $net using 1:2:(0) with lines lc rgb "#9a9a9a" lw 0.7 dt solid notitle, \
      $rings using 1:2:(0):(sprintf("%g", $3)):4 with labels font ",12" tc rgb variable offset 0.8,0.5 notitle, \
      $marks using 1:2:(0) with points pt 6 ps 1.6 lw 2 lc rgb "#00b3c4" notitle
