% A program for `mceip conform`: every support by eig, for Octave (7 or later) and MATLAB.
%
%     mceip conform --as-pencil --lines -- octave-cli -q spec/examples/adapter.m --lines
%     mceip conform --as-pencil --lines -- matlab -batch "run spec/examples/adapter.m"
%
% Reads a pencil (mceip-problem/1) on each line of stdin and prints mceip-solutions/1 in one line.
% It is adapter.py in another language: floats and one tolerance, so that repeated roots, biactive
% indices, cones, continua and blocks whose first and last matrices are singular are beyond it.
1; % Octave: a script, not a file of one function

function out = number(value)
  % An exact entry ("1/3", "0.1", 2) as a double; numerators and denominators of any length.
  if isnumeric(value)
    out = double(value);
    return
  end
  parts = strsplit(value, '/');
  if numel(parts) == 1
    out = str2double(value);
    return
  end
  [p, p_exponent] = leading(parts{1});
  [q, q_exponent] = leading(parts{2});
  out = p / q * 10 ^ (p_exponent - q_exponent);
end

function [mantissa, exponent] = leading(digits)
  % The first 18 letters of an integer, and how many are left out.
  kept = min(numel(digits), 18);
  mantissa = str2double(digits(1:kept));
  exponent = numel(digits) - kept;
end

function out = matrix(m)
  % {rows, cols, entries} with exact entries, as doubles.
  out = zeros(m.rows, m.cols);
  for k = 1:numel(m.entries)
    entry = m.entries{k};
    out(entry{1} + 1, entry{2} + 1) = number(entry{3});
  end
end

function [values, vectors] = eigenpairs(matrices, tolerance)
  % (t, x) with (A + tB) x = 0, or (A + tB + t^2 C) x = 0, t real: by the last matrix where it is
  % regular, else by the first one and 1/t.
  n = size(matrices{1}, 1);
  values = [];
  vectors = zeros(n, 0);
  by_last = rank(matrices{end}) == n;
  if ~by_last
    matrices = flip(matrices);
  end
  if rank(matrices{end}) < n
    return % both singular: given up
  end
  degree = numel(matrices) - 1;
  companion = diag(ones(n * (degree - 1), 1), n); % of x, t x, ...
  for k = 1:degree
    companion(n * (degree - 1) + (1:n), n * (k - 1) + (1:n)) = -(matrices{end} \ matrices{k});
  end
  [all_vectors, all_values] = eig(companion);
  all_values = diag(all_values);
  is_real = abs(imag(all_values)) < tolerance * (1 + abs(all_values));
  if by_last
    values = real(all_values(is_real));
  else
    is_real = is_real & abs(all_values) > tolerance;
    values = 1 ./ real(all_values(is_real));
  end
  vectors = real(all_vectors(1:n, is_real));
end

function out = vector_text(x)
  % [1.5,0,2]
  out = ['[', strjoin(arrayfun(@(v) sprintf('%.17g', v), x(:)', 'UniformOutput', false), ','), ']'];
end

function out = report(problem)
  % The report on a problem, in one line.
  tolerance = 1e-8;
  matrices = {matrix(problem.pencil.a), matrix(problem.pencil.b)};
  if isfield(problem.pencil, 'c')
    matrices{3} = matrix(problem.pencil.c);
  end
  n = size(matrices{1}, 1);
  scale = max(cellfun(@(m) max(abs(m(:))), matrices));
  free = [];
  if isfield(problem.pencil, 'free')
    free = double(problem.pencil.free(:))' + 1;
  end
  slip = setdiff(1:n, free);
  low = -Inf;
  if ~isempty(problem.window.min)
    low = number(problem.window.min);
  end
  high = Inf;
  if ~isempty(problem.window.max)
    high = number(problem.window.max);
  end

  found = {};
  for code = 1:2 ^ numel(slip) - 1
    support = slip(bitand(code, 2 .^ (0:numel(slip) - 1)) > 0);
    rest = setdiff(slip, support);
    active = sort([free, support]);
    blocks = cellfun(@(m) m(active, active), matrices, 'UniformOutput', false);
    [values, vectors] = eigenpairs(blocks, tolerance);
    for k = 1:numel(values)
      t = values(k);
      if t < low - tolerance || t > high + tolerance
        continue
      end
      total = sum(vectors(ismember(active, support), k));
      if total == 0
        total = 1;
      end
      x = zeros(n, 1);
      x(active) = vectors(:, k) / total;
      y = zeros(n, 1);
      for power = 1:numel(matrices)
        y = y + t ^ (power - 1) * (matrices{power} * x);
      end
      if all(x(support) > tolerance) && all(y(rest) >= -tolerance * scale)
        found{end + 1} = sprintf('{"value":%.17g,"x":%s}', max(low, t), vector_text(x));
      end
    end
  end
  out = ['{"format":"mceip-solutions/1","solutions":[', strjoin(found, ','), ']}'];
end

function out = next_line(file)
  % The next line, or nothing at the end. Octave's fgetl waits for the line after it.
  out = '';
  letter = fread(file, 1, '*char');
  while ~isempty(letter) && letter ~= newline
    out(end + 1) = letter;
    letter = fread(file, 1, '*char');
  end
end

input_file = fopen('/dev/stdin', 'r');
while true
  line = next_line(input_file);
  if isempty(line)
    break
  end
  fprintf('%s\n', report(jsondecode(line)));
  if exist('OCTAVE_VERSION', 'builtin')
    fflush(stdout);
  end
end
