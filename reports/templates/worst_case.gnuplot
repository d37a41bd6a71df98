# Changes within the limits over a ladder of samples: $changes, rows (number of the sample, lowest,
# highest, as built / GU); `samples` is how many samples there are.
set terminal svg size 560,350 font "sans-serif,17" background "#ffffff"
set xlabel "sample, from matt to mirror"
set ylabel "change within the limits / GU"
set xrange [0.5:samples + 0.5]
set xtics 1
set yrange [y_low:y_high]
set format y "%g"
set grid ytics
unset key
plot NaN notitle, $changes using 1:(0.5 * ($2 + $3)):($1 - 0.3):($1 + 0.3):2:3 with boxxyerror \
       lw 1 dt solid fc rgb "#d9d2c3" fs solid 1.0 border lc rgb "#5a5a5a" notitle, \
     0 with lines lc rgb "#444444" lw 1 dt solid notitle, \
     $changes using 1:4 with points lt 1 ps 0.9 notitle
