# The joint region of two parameters: $ellipse, its edge (x, y); $estimate, its middle.
set terminal svg size 560,470 font "sans-serif,15" background "#ffffff"
set xlabel "first parameter"
set ylabel "second parameter"
set format x "%.7g"
set format y "%.7g"
set xtics rotate by -30
set xrange [x_low:x_high]
set yrange [y_low:y_high]
set key outside top center horizontal samplen 2.5
plot $ellipse using 1:2 with lines lt 1 title "1", $estimate using 1:2 with points lt 2 pt 7 title "2"
